//! Everything a person can do by one key, in one table.
//!
//! The table feeds the dispatch of keys, the footer, the help page, the names of the command line
//! and the keys section of the guide.

use crate::explorer::key::Key;

/// The heading under which the help page lists an action.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Group {
    /// Moving the cursor over the pixels.
    Cursor,
    /// Moving the eye.
    Camera,
    /// Choosing and changing spheres.
    Spheres,
    /// What the picture and the panel show.
    View,
    /// Walking through the mathematics of one pixel.
    Steps,
    /// Errors and times of the methods on this picture.
    Laboratory,
    /// Walking through the chapters that tell it all.
    Tour,
    /// Files, history, the program itself.
    Program,
}

impl Group {
    /// All groups, in the order of the help page.
    pub const ALL: [Self; 8] = [
        Self::Cursor,
        Self::Camera,
        Self::Spheres,
        Self::View,
        Self::Steps,
        Self::Laboratory,
        Self::Tour,
        Self::Program,
    ];

    /// The heading.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Cursor => "Cursor",
            Self::Camera => "Camera",
            Self::Spheres => "Spheres",
            Self::View => "View",
            Self::Steps => "Step by step",
            Self::Laboratory => "Errors and times",
            Self::Tour => "Tour",
            Self::Program => "Program",
        }
    }
}

macro_rules! actions {
    ($( #[doc = $help:literal] $variant:ident $name:literal [$($key:literal),*] $group:ident; )*) => {
        /// What one key does.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum Action {
            $( #[doc = $help] $variant, )*
        }

        impl Action {
            /// All actions, in the order of the help page.
            pub const ALL: &[Self] = &[$( Self::$variant, )*];

            /// The name on the command line (`:`).
            pub const fn name(self) -> &'static str {
                match self { $( Self::$variant => $name, )* }
            }

            /// The keys that do it, as `Key::parse` reads them.
            pub const fn keys(self) -> &'static [&'static str] {
                match self { $( Self::$variant => &[$($key),*], )* }
            }

            /// What it does, in a few words.
            pub const fn help(self) -> &'static str {
                match self { $( Self::$variant => $help.trim_ascii(), )* }
            }

            /// The heading under which it is listed.
            pub const fn group(self) -> Group {
                match self { $( Self::$variant => Group::$group, )* }
            }
        }
    };
}

actions! {
    /// cursor one pixel left
    CursorLeft "cursor-left" ["left", "h"] Cursor;
    /// cursor one pixel right
    CursorRight "cursor-right" ["right", "l"] Cursor;
    /// cursor one pixel up
    CursorUp "cursor-up" ["up", "k"] Cursor;
    /// cursor one pixel down
    CursorDown "cursor-down" ["down", "j"] Cursor;
    /// cursor eight pixels left
    CursorFarLeft "cursor-far-left" ["shift-left"] Cursor;
    /// cursor eight pixels right
    CursorFarRight "cursor-far-right" ["shift-right"] Cursor;
    /// cursor eight pixels up
    CursorFarUp "cursor-far-up" ["shift-up"] Cursor;
    /// cursor eight pixels down
    CursorFarDown "cursor-far-down" ["shift-down"] Cursor;
    /// cursor to the centre of the picture
    CursorCenter "cursor-center" ["'"] Cursor;
    /// cursor to the nearest tangent pixel, or the nearest to one
    SnapTangent "snap-tangent" ["t"] Cursor;
    /// cursor to the next place worth looking at
    NextProbe "next-probe" ["n"] Cursor;
    /// cursor to the previous place worth looking at
    PreviousProbe "previous-probe" ["N"] Cursor;

    /// orbit to the left about the point looked at
    OrbitLeft "orbit-left" ["a"] Camera;
    /// orbit to the right
    OrbitRight "orbit-right" ["d"] Camera;
    /// orbit upwards
    OrbitUp "orbit-up" ["w"] Camera;
    /// orbit downwards
    OrbitDown "orbit-down" ["s"] Camera;
    /// move the camera left
    PanLeft "pan-left" ["A"] Camera;
    /// move the camera right
    PanRight "pan-right" ["D"] Camera;
    /// move the camera up
    PanUp "pan-up" ["W"] Camera;
    /// move the camera down
    PanDown "pan-down" ["S"] Camera;
    /// dolly: move the camera forward
    DollyIn "dolly-in" ["e"] Camera;
    /// dolly: move the camera back
    DollyOut "dolly-out" ["E"] Camera;
    /// zoom in: see less, larger
    ZoomIn "zoom-in" ["+"] Camera;
    /// zoom out: see more, smaller
    ZoomOut "zoom-out" ["-"] Camera;
    /// look at the selected sphere
    LookAtSphere "look-at-sphere" ["c"] Camera;
    /// camera as the scene has it
    Home "home" ["home", "0"] Camera;

    /// select the next sphere
    NextSphere "next-sphere" ["tab"] Spheres;
    /// select the previous sphere
    PreviousSphere "previous-sphere" ["backtab"] Spheres;
    /// show the next sphere on the line of the ray
    NextOnLine "next-on-line" ["space"] Spheres;
    /// select the sphere that the panel shows
    SelectShown "select-shown" [";"] Spheres;
    /// move the sphere along +x
    MoveXPlus "move-x-plus" ["x"] Spheres;
    /// move the sphere along −x
    MoveXMinus "move-x-minus" ["X"] Spheres;
    /// move the sphere along +y
    MoveYPlus "move-y-plus" ["y"] Spheres;
    /// move the sphere along −y
    MoveYMinus "move-y-minus" ["Y"] Spheres;
    /// move the sphere along +z
    MoveZPlus "move-z-plus" ["z"] Spheres;
    /// move the sphere along −z
    MoveZMinus "move-z-minus" ["Z"] Spheres;
    /// make the sphere larger
    Grow "grow" ["g"] Spheres;
    /// make the sphere smaller
    Shrink "shrink" ["G"] Spheres;
    /// coarser steps
    StepCoarser "step-coarser" ["]"] Spheres;
    /// finer steps
    StepFiner "step-finer" ["["] Spheres;
    /// make the pixel under the cursor tangent: the radius for which Δ = 0
    MakeTangent "make-tangent" ["T"] Spheres;
    /// add a sphere in front of the camera
    Add "add" ["i"] Spheres;
    /// duplicate the selected sphere
    Duplicate "duplicate" ["o"] Spheres;
    /// delete the selected sphere
    Delete "delete" ["delete"] Spheres;
    /// type exact values: the numbers of the sphere and the camera
    Edit "edit" ["="] Spheres;

    /// the other lens: the mathematics of a pixel, or the machine's arithmetic
    OtherLens "other-lens" ["L"] View;
    /// next method
    NextMethod "next-method" ["m"] View;
    /// previous method
    PreviousMethod "previous-method" ["M"] View;
    /// next view: shade, class, …
    NextView "next-view" ["v"] View;
    /// previous view
    PreviousView "previous-view" ["V"] View;
    /// next style: half, braille, ascii, tutorial
    NextStyle "next-style" ["b"] View;
    /// previous style
    PreviousStyle "previous-style" ["B"] View;
    /// numbers in full precision, or rounded to be read
    Precision "precision" ["p"] View;
    /// cells taken to be taller
    AspectTaller "aspect-taller" ["}"] View;
    /// cells taken to be wider
    AspectWider "aspect-wider" ["{"] View;
    /// next theme: dark, light, high-contrast, monochrome
    NextTheme "next-theme" ["@"] View;
    /// next number of colours: 256, true, never, 16
    NextColor "next-color" ["#"] View;
    /// scroll the panel down
    ScrollDown "scroll-down" ["pagedown"] View;
    /// scroll the panel up
    ScrollUp "scroll-up" ["pageup"] View;

    /// panel: A, B, C and Δ
    PanelQuadratic "panel-quadratic" ["1"] Steps;
    /// panel: the derivation, a step at a time
    PanelSteps "panel-steps" ["2"] Steps;
    /// panel: the plane through ray and centre
    PanelSlice "panel-slice" ["3"] Steps;
    /// panel: the curve f(t) = At² + Bt + C
    PanelCurve "panel-curve" ["4"] Steps;
    /// panel: the bits of the step's number
    PanelBits "panel-bits" ["5"] Steps;
    /// panel: the chosen method beside another
    PanelCompare "panel-compare" ["6"] Steps;
    /// panel: error against run time for this picture
    PanelError "panel-error" ["7"] Steps;
    /// panel: what this frame needed, what was left out, and why
    PanelPlan "panel-plan" ["8"] Steps;
    /// open the steps; go to the next one, or reveal its answer
    NextStep "next-step" ["enter", "."] Steps;
    /// previous step
    PreviousStep "previous-step" ["backspace", ","] Steps;
    /// first step
    FirstStep "first-step" ["<"] Steps;
    /// last step
    LastStep "last-step" [">"] Steps;
    /// predict, then reveal: hide picture and results until a key
    Predict "predict" ["P"] Steps;
    /// board: one step, large, for the back row
    Board "board" ["O"] Steps;
    /// scrub t forward along the ray
    ScrubForward "scrub-forward" [")"] Steps;
    /// scrub t back along the ray
    ScrubBack "scrub-back" ["("] Steps;
    /// t to the next landmark of the line: p0, a root, the point closest to the centre
    NextLandmark "next-landmark" ["*"] Steps;
    /// t to the landmark before
    PreviousLandmark "previous-landmark" ["_"] Steps;
    /// t back to where something is seen
    ScrubHome "scrub-home" ["/"] Steps;
    /// compare with the next method
    NextComparison "next-comparison" ["C"] Steps;

    /// time all methods on this picture, on a thread of its own; again: stop
    Measure "measure" ["%"] Laboratory;

    /// panel: a dial on this scene; again: the next dial
    NextDial "next-dial" ["9"] Laboratory;
    /// turn the dial on, from tame to broken
    TurnOn "turn-on" ["\\"] Laboratory;
    /// turn the dial back
    TurnBack "turn-back" ["|"] Laboratory;
    /// copy this pixel as a row for `rayscope grade`; again: as a test case in C, in Rust
    CopyCase "copy-case" ["&"] Laboratory;

    /// open the tour; go to its next page
    TourForward "tour-forward" ["f"] Tour;
    /// previous page
    TourBack "tour-back" ["F"] Tour;
    /// this page again: everything as the page has it
    TourAgain "tour-again" ["r"] Tour;
    /// next chapter
    TourNextChapter "tour-next-chapter" ["ctrl-n"] Tour;
    /// first page of this chapter, or of the one before
    TourPreviousChapter "tour-previous-chapter" ["ctrl-p"] Tour;
    /// put the tour away and go back to your own scene; return to the tour
    Tour "tour" ["ctrl-t"] Tour;

    /// this help
    Help "help" ["?", "f1"] Program;
    /// type a command by name; tab completes
    CommandLine "command-line" [":"] Program;
    /// undo
    Undo "undo" ["u"] Program;
    /// redo
    Redo "redo" ["U", "ctrl-r"] Program;
    /// reset the scene to what was opened (can be undone)
    Reset "reset" ["R"] Program;
    /// use the mouse: a click moves the cursor, the wheel zooms; or leave it to select text
    Mouse "mouse" ["$"] Program;
    /// draw the whole screen again
    Redraw "redraw" ["ctrl-l"] Program;
    /// open a scene
    Open "open" ["ctrl-o"] Program;
    /// save the scene
    Save "save" ["ctrl-s"] Program;
    /// save the scene under another name
    SaveAs "save-as" ["ctrl-a"] Program;
    /// show and copy the command that reopens this very view
    Link "link" ["ctrl-y"] Program;
    /// stop, for the shell to take over; its `fg` comes back
    Suspend "suspend" ["ctrl-z"] Program;
    /// quit; asks if there are unsaved changes
    Quit "quit" ["q"] Program;
}

impl Action {
    /// The action of that name.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|a| a.name() == name)
    }

    /// What the keys of this action do to a camera whose pixels are on a grid: they slide it where they
    /// orbit others, since an orbit leaves the grid, and the reverse.
    #[must_use]
    pub const fn on_grid(self) -> Self {
        match self {
            Self::OrbitLeft => Self::PanLeft,
            Self::OrbitRight => Self::PanRight,
            Self::OrbitUp => Self::PanUp,
            Self::OrbitDown => Self::PanDown,
            Self::PanLeft => Self::OrbitLeft,
            Self::PanRight => Self::OrbitRight,
            Self::PanUp => Self::OrbitUp,
            Self::PanDown => Self::OrbitDown,
            other => other,
        }
    }

    /// The action that a key is bound to.
    pub fn bound_to(key: Key) -> Option<Self> {
        Self::ALL
            .iter()
            .copied()
            .find(|a| a.keys().iter().any(|k| Key::parse(k) == Some(key)))
    }
}

/// What the footer says: keys and a word, the most useful first.
pub const FOOTER: &[(&str, &str)] = &[
    ("arrows", "cursor"),
    ("wasd", "camera"),
    ("tab", "sphere"),
    ("enter", "steps"),
    ("v", "view"),
    ("m", "method"),
    ("f", "tour"),
    (":", "command"),
    ("?", "help"),
    ("q", "quit"),
    ("1-9", "panels"),
    ("b", "style"),
    ("xyz", "move"),
    ("g", "grow"),
    ("t", "tangent"),
    ("n", "probe"),
    ("*", "landmark"),
    ("u", "undo"),
    ("=", "numbers"),
    ("p", "digits"),
];

/// The keys section of the guide, in Markdown.
pub fn markdown() -> String {
    Group::ALL.map(group_in_markdown).join("\n")
}

fn group_in_markdown(group: Group) -> String {
    let head = format!(
        "### {}\n\n| key | does | `:` name |\n|---|---|---|\n",
        group.title()
    );
    let rows = Action::ALL.iter().filter(|a| a.group() == group).map(|a| {
        // A bar ends a cell of a table, in code as well.
        let key = |k: &&str| format!("`{}`", k.replace('|', "\\|"));
        let keys: Vec<_> = a.keys().iter().map(key).collect();
        format!("| {} | {} | `{}` |\n", keys.join(" "), a.help(), a.name())
    });
    head + &rows.collect::<String>()
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    #[test]
    fn no_key_and_no_name_stands_twice() {
        let mut keys = HashSet::new();
        let mut names = HashSet::new();
        for action in Action::ALL {
            assert!(names.insert(action.name()), "{} twice", action.name());
            for text in action.keys() {
                let key = Key::parse(text).unwrap_or_else(|| panic!("{text} is no key"));
                assert!(keys.insert(key), "{text} is bound twice");
                assert_eq!(Action::bound_to(key), Some(*action));
            }
        }
    }
}
