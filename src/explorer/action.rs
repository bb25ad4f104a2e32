//! Everything a person can do by one key or by the menu, in one table.
//!
//! The table feeds the dispatch of keys, the menu, the help page, the names of the command
//! line and the keys section of the guide.

use crate::explorer::key::Key;
use crate::scene::Camera;
use crate::text::by_name;

/// A column of the menu.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Column {
    /// What is seen, and from where.
    Look,
    /// One pixel, step by step, and the tour.
    Learn,
    /// Spheres, files, history.
    Build,
    /// Methods, their errors and times.
    Numerics,
}

impl Column {
    /// All columns, from left to right.
    pub const ALL: [Self; 4] = [Self::Look, Self::Learn, Self::Build, Self::Numerics];

    /// Its title.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Look => "Look",
            Self::Learn => "Learn",
            Self::Build => "Build",
            Self::Numerics => "Numerics",
        }
    }

    /// The letter that opens it in the menu.
    pub const fn letter(self) -> char {
        match self {
            Self::Look => 'l',
            Self::Learn => 'e',
            Self::Build => 'b',
            Self::Numerics => 'n',
        }
    }

    /// Its actions, in order.
    pub fn actions(self) -> impl Iterator<Item = Action> {
        let all = Action::ALL.iter().copied();
        all.filter(move |action| action.group().column() == self)
    }

    /// Its rows: what belongs together, such as the four ways to move the cursor, is one row.
    pub fn rows(self) -> Vec<Vec<Action>> {
        let mut rows: Vec<Vec<Action>> = Vec::new();
        for action in self.actions() {
            match rows.last_mut() {
                Some(row) if row[0].row() == action.row() => row.push(action),
                _ => rows.push(vec![action]),
            }
        }
        rows
    }
}

/// The heading under which the help page lists an action.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Group {
    /// Moving the cursor over the pixels.
    Cursor,
    /// Moving the eye.
    Camera,
    /// What the picture and the panel show.
    View,
    /// The lens, and walking through one pixel.
    Steps,
    /// Walking through the chapters that tell it all.
    Tour,
    /// Choosing and changing spheres.
    Spheres,
    /// Files, history, the program itself.
    Program,
    /// Methods, and their errors and times on this picture.
    Laboratory,
}

impl Group {
    /// All groups, in the order of the help page.
    pub const ALL: [Self; 8] = [
        Self::Cursor,
        Self::Camera,
        Self::View,
        Self::Steps,
        Self::Tour,
        Self::Spheres,
        Self::Program,
        Self::Laboratory,
    ];

    /// The heading.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Cursor => "Cursor",
            Self::Camera => "Camera",
            Self::View => "View",
            Self::Steps => "Step by step",
            Self::Tour => "Tour",
            Self::Spheres => "Spheres",
            Self::Program => "Program",
            Self::Laboratory => "Methods, errors and times",
        }
    }

    /// The column of the menu that has its actions.
    pub const fn column(self) -> Column {
        match self {
            Self::Cursor | Self::Camera | Self::View => Column::Look,
            Self::Steps | Self::Tour => Column::Learn,
            Self::Spheres | Self::Program => Column::Build,
            Self::Laboratory => Column::Numerics,
        }
    }
}

macro_rules! actions {
    ($(
        #[doc = $help:literal]
        $variant:ident $name:literal [$($key:literal),*] $group:ident $letter:literal $row:literal;
    )*) => {
        /// What one key does.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum Action {
            $( #[doc = $help] $variant, )*
        }

        impl Action {
            /// All actions, in the order of the help page.
            pub const ALL: &[Self] = &[$( Self::$variant, )*];

            /// The name in the menu and on the command line (`:`).
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

            /// The letter that chooses it in its column of the menu.
            pub const fn letter(self) -> char {
                match self { $( Self::$variant => $letter, )* }
            }

            /// What it and those that belong to it are called in the menu.
            pub const fn row(self) -> &'static str {
                match self { $( Self::$variant => $row, )* }
            }
        }
    };
}

actions! {
    /// cursor one pixel left
    CursorLeft "left" ["left", "h"] Cursor 'h' "cursor";
    /// cursor one pixel right
    CursorRight "right" ["right", "l"] Cursor 'l' "cursor";
    /// cursor one pixel up
    CursorUp "up" ["up", "k"] Cursor 'k' "cursor";
    /// cursor one pixel down
    CursorDown "down" ["down", "j"] Cursor 'j' "cursor";
    /// cursor eight pixels left
    CursorFarLeft "far-left" ["shift-left"] Cursor 'H' "by eight";
    /// cursor eight pixels right
    CursorFarRight "far-right" ["shift-right"] Cursor 'L' "by eight";
    /// cursor eight pixels up
    CursorFarUp "far-up" ["shift-up"] Cursor 'K' "by eight";
    /// cursor eight pixels down
    CursorFarDown "far-down" ["shift-down"] Cursor 'J' "by eight";
    /// cursor to the centre of the picture
    CursorCenter "center" [] Cursor 'c' "centre";
    /// cursor to the nearest pixel whose ray touches
    SnapTangent "tangent" ["t"] Cursor 't' "tangent";
    /// cursor to the scene's next place to look at
    NextProbe "next-place" ["N"] Cursor 'n' "next place";
    /// cursor to the scene's previous place
    PreviousProbe "previous-place" [] Cursor 'N' "next place";

    /// orbit to the left about what you look at
    OrbitLeft "orbit-left" ["a"] Camera 'a' "orbit";
    /// orbit to the right
    OrbitRight "orbit-right" ["d"] Camera 'd' "orbit";
    /// orbit upwards
    OrbitUp "orbit-up" ["w"] Camera 'w' "orbit";
    /// orbit downwards
    OrbitDown "orbit-down" ["s"] Camera 's' "orbit";
    /// move the camera left
    PanLeft "slide-left" ["A"] Camera 'A' "slide";
    /// move the camera right
    PanRight "slide-right" ["D"] Camera 'D' "slide";
    /// move the camera up
    PanUp "slide-up" ["W"] Camera 'W' "slide";
    /// move the camera down
    PanDown "slide-down" ["S"] Camera 'S' "slide";
    /// move the camera forward
    DollyIn "forward" ["e"] Camera 'e' "forward";
    /// move the camera back
    DollyOut "backward" ["E"] Camera 'E' "forward";
    /// zoom in: see less, larger
    ZoomIn "zoom-in" ["+"] Camera '+' "zoom";
    /// zoom out: see more, smaller
    ZoomOut "zoom-out" ["-"] Camera '-' "zoom";
    /// look at the selected sphere
    LookAtSphere "look-at" [] Camera 'o' "look at sphere";
    /// put the camera back where the scene has it
    Home "home" ["home", "0"] Camera '0' "home";

    /// next view: shade, class, …
    NextView "next-view" ["v"] View 'v' "view";
    /// previous view
    PreviousView "previous-view" ["V"] View 'V' "view";
    /// next style: half, braille, ascii, tutorial
    NextStyle "next-style" [] View 'b' "style";
    /// previous style
    PreviousStyle "previous-style" [] View 'B' "style";
    /// show numbers in full, or rounded
    Precision "digits" [] View 'p' "digits";
    /// take the cells of the screen to be taller
    AspectTaller "taller" [] View '}' "shape of cells";
    /// take the cells of the screen to be wider
    AspectWider "wider" [] View '{' "shape of cells";
    /// next theme: dark, light, high-contrast, …
    NextTheme "next-theme" ["@"] View '@' "theme";
    /// next number of colours: 256, true, never, 16
    NextColor "next-color" ["#"] View '#' "colours";
    /// scroll the panel down
    ScrollDown "scroll-down" ["pagedown"] View 'f' "scroll";
    /// scroll the panel up
    ScrollUp "scroll-up" ["pageup"] View 'F' "scroll";
    /// mouse on: click to point, wheel to zoom; or off
    Mouse "mouse" ["$"] View 'm' "mouse";
    /// draw the whole screen again
    Redraw "redraw" ["ctrl-l"] View 'r' "redraw";

    /// open the steps; write the next one
    NextStep "next" ["enter", "."] Steps 'n' "next step";
    /// previous step
    PreviousStep "back" [",", "backspace"] Steps 'b' "back";
    /// first step
    FirstStep "first" ["<"] Steps '<' "first, last";
    /// last step
    LastStep "last" [">"] Steps '>' "first, last";
    /// predict: type each result before it is shown
    Predict "predict" ["P"] Steps 'P' "predict";
    /// board: one step, large, for the back row
    Board "board" ["O"] Steps 'O' "board";
    /// show the next sphere on this line
    NextOnLine "next-on-line" ["n"] Steps 'o' "sphere on line";
    /// panel: A, B, C and Δ
    PanelQuadratic "quadratic" ["1"] Steps '1' "numbers";
    /// panel: the sheet, a line at a time
    PanelSteps "steps" ["2"] Steps '2' "steps";
    /// panel: ray and sphere from the side
    PanelSlice "slice" ["3"] Steps '3' "side view";
    /// panel: the curve f(t) = At² + Bt + C
    PanelCurve "curve" ["4"] Steps '4' "curve";
    /// move the point p forward along the ray
    ScrubForward "point-forward" [")"] Steps ')' "point on ray";
    /// move the point p back along the ray
    ScrubBack "point-back" ["("] Steps '(' "point on ray";
    /// p to the next landmark: p0, a root, …
    NextLandmark "next-landmark" ["*"] Steps '*' "landmark";
    /// p to the previous landmark
    PreviousLandmark "previous-landmark" ["_"] Steps '_' "landmark";
    /// p back to the point that is seen
    ScrubHome "point-home" ["/"] Steps '/' "p to what is seen";

    /// open the tour; go to its next page
    TourForward "tour-forward" ["f"] Tour 'f' "tour";
    /// previous page
    TourBack "tour-back" ["F"] Tour 'F' "tour";
    /// set everything as the page has it
    TourAgain "tour-again" ["r"] Tour 'r' "page again";
    /// next chapter
    TourNextChapter "tour-next-chapter" ["ctrl-n"] Tour 'c' "chapter";
    /// first page of this chapter, or the previous one
    TourPreviousChapter "tour-previous-chapter" ["ctrl-p"] Tour 'C' "chapter";
    /// leave the tour for your own scene; return to it
    Tour "tour" ["ctrl-t"] Tour 't' "leave tour";

    /// select the next sphere
    NextSphere "next-sphere" ["tab"] Spheres 'n' "select";
    /// select the previous sphere
    PreviousSphere "previous-sphere" ["backtab"] Spheres 'N' "select";
    /// select the sphere that the panel shows
    SelectShown "select-shown" [] Spheres 'l' "select shown";
    /// move the sphere along +x
    MoveXPlus "move-x-plus" ["x"] Spheres 'x' "move";
    /// move the sphere along +y
    MoveYPlus "move-y-plus" ["y"] Spheres 'y' "move";
    /// move the sphere along +z
    MoveZPlus "move-z-plus" ["z"] Spheres 'z' "move";
    /// move the sphere along −x
    MoveXMinus "move-x-minus" ["X"] Spheres 'X' "move";
    /// move the sphere along −y
    MoveYMinus "move-y-minus" ["Y"] Spheres 'Y' "move";
    /// move the sphere along −z
    MoveZMinus "move-z-minus" ["Z"] Spheres 'Z' "move";
    /// make the sphere larger
    Grow "grow" ["g"] Spheres 'g' "size";
    /// make the sphere smaller
    Smaller "smaller" ["G"] Spheres 'G' "size";
    /// coarser steps
    StepCoarser "coarser" ["]"] Spheres ']' "step length";
    /// finer steps
    StepFiner "finer" ["["] Spheres '[' "step length";
    /// change the radius so that this ray touches
    MakeTangent "make-tangent" ["T"] Spheres 'T' "make tangent";
    /// add a sphere in front of the cursor, selected
    Add "add" ["i"] Spheres 'a' "add sphere";
    /// duplicate the selected sphere
    Duplicate "duplicate" [] Spheres 'd' "duplicate";
    /// delete the selected sphere
    Delete "delete" ["delete"] Spheres 'r' "remove";
    /// type the numbers of sphere and camera
    Edit "values" ["="] Spheres 'v' "type values";

    /// undo
    Undo "undo" ["u"] Program 'u' "undo, redo";
    /// redo
    Redo "redo" ["U", "ctrl-r"] Program 'U' "undo, redo";
    /// bring back the opened scene (can be undone)
    Reset "reset" [] Program 'R' "reset";
    /// open a scene
    Open "open" ["ctrl-o"] Program 'o' "open";
    /// save the scene
    Save "save" ["ctrl-s"] Program 's' "save";
    /// save the scene under another name
    SaveAs "save-as" ["ctrl-a"] Program 'S' "save";
    /// show and copy the command for this very view
    Link "link" ["ctrl-y"] Program 'L' "link";
    /// all actions in a menu, by arrows or letters
    Menu "menu" ["space", "f1"] Program 'm' "menu";
    /// type a command by name; what fits is listed
    CommandLine "command-line" [":"] Program ':' "command";
    /// all keys and commands
    Help "help" ["?"] Program '?' "all keys";
    /// stop the program; the shell's `fg` continues it
    Suspend "suspend" ["ctrl-z"] Program 't' "stop";
    /// quit; asks if there are unsaved changes
    Quit "quit" ["q"] Program 'q' "quit";

    /// lens: mathematics, or the machine's arithmetic
    OtherLens "other-lens" ["L"] Laboratory 'l' "other lens";
    /// next method
    NextMethod "next-method" ["m"] Laboratory 'm' "method";
    /// previous method
    PreviousMethod "previous-method" ["M"] Laboratory 'M' "method";
    /// panel: the bits of the step's number
    PanelBits "bits" ["5"] Laboratory '5' "bits";
    /// panel: this method beside another
    PanelCompare "compare" ["6"] Laboratory '6' "compare";
    /// compare with the next method
    NextComparison "next-comparison" [] Laboratory 'c' "compare with";
    /// panel: error and run time for this picture
    PanelError "error" ["7"] Laboratory '7' "error and time";
    /// time all methods on this picture; again: stop
    Measure "measure" ["%"] Laboratory '%' "measure";
    /// panel: what this frame needed and left out, why
    PanelPlan "plan" ["8"] Laboratory '8' "plan of frame";
    /// panel: a dial for this scene; again: the next
    NextDial "next-dial" ["9"] Laboratory '9' "dial";
    /// turn the dial up, towards where methods break
    TurnOn "turn-on" ["\\"] Laboratory '\\' "turn the dial";
    /// turn the dial back
    TurnBack "turn-back" ["|"] Laboratory '|' "turn the dial";
    /// copy this pixel: as a row; again: as C, as Rust
    CopyCase "copy-case" ["&"] Laboratory '&' "copy pixel";
}

impl Action {
    /// The action of that name.
    pub fn by_name(name: &str) -> Option<Self> {
        by_name(Self::ALL.iter().copied(), Self::name, name)
    }

    /// A sentence with each `{action}` in it put as its key, or by its name where there are no keys.
    pub fn spell(text: &str, by_name: bool) -> String {
        let mut pieces = text.split('{');
        let mut spelt = pieces.next().unwrap_or_default().to_owned();
        for piece in pieces {
            let action = piece.split_once('}');
            let action = action.and_then(|(name, rest)| Some((Self::by_name(name)?, rest)));
            if let Some((action, rest)) = action {
                let key = action.keys().first().filter(|_| !by_name);
                spelt += key.copied().unwrap_or_else(|| action.name());
                spelt += rest;
            } else {
                spelt.push('{');
                spelt += piece;
            }
        }
        spelt
    }

    /// What is typed for it in the menu: `space l t`.
    pub fn prefix(self) -> String {
        format!("space {} {}", self.group().column().letter(), self.letter())
    }

    /// What the keys of this action do to a camera whose pixels are on a grid: they slide it where they
    /// orbit others, since an orbit leaves the grid, and the reverse.
    const fn on_grid(self) -> Self {
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

    /// What the keys of this action do to that camera.
    #[must_use]
    pub fn as_with(self, camera: &Camera) -> Self {
        match camera.step() {
            Some(_) => self.on_grid(),
            None => self,
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

/// The keys section of the guide, in Markdown.
pub fn markdown() -> String {
    Group::ALL.map(group_in_markdown).join("\n")
}

fn group_in_markdown(group: Group) -> String {
    let head = format!(
        "### {}\n\n| key | menu | does | name |\n|---|---|---|---|\n",
        group.title()
    );
    let rows = Action::ALL.iter().filter(|a| a.group() == group).map(|a| {
        // A bar ends a cell of a table, in code as well.
        let code = |k: &str| format!("`{}`", k.replace('|', "\\|"));
        let keys: Vec<_> = a.keys().iter().map(|key| code(key)).collect();
        let prefix = code(&a.prefix());
        let keys = keys.join(" ");
        format!("| {keys} | {prefix} | {} | `{}` |\n", a.help(), a.name())
    });
    head + &rows.collect::<String>()
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    #[test]
    fn what_belongs_together_is_one_row_of_a_menu_that_fits_the_usual_screen() {
        for column in Column::ALL {
            let rows = column.rows();
            let names: HashSet<_> = rows.iter().map(|row| row[0].row()).collect();
            assert_eq!(names.len(), rows.len(), "{}", column.title());
            assert!(rows.len() <= 20, "{}: {}", column.title(), rows.len());
        }
    }

    #[test]
    fn what_an_action_does_fits_beside_its_name_on_the_usual_screen() {
        for action in Action::ALL {
            let help = action.help();
            assert!(help.chars().count() <= 47, "{}: {help}", action.name());
        }
    }

    #[test]
    fn no_key_and_no_name_is_there_twice() {
        let mut keys = HashSet::new();
        let mut names = HashSet::new();
        let mut prefixes = HashSet::new();
        for action in Action::ALL {
            assert!(names.insert(action.name()), "{} twice", action.name());
            let prefix = action.prefix();
            assert!(prefixes.insert(prefix.clone()), "{prefix} twice");
            for text in action.keys() {
                let key = Key::parse(text).unwrap_or_else(|| panic!("{text} is no key"));
                assert!(keys.insert(key), "{text} is bound twice");
                assert_eq!(Action::bound_to(key), Some(*action));
            }
        }
    }
}
