//! Frames that follow each other allocate nothing, and reading a routine takes a bounded amount of memory. This binary
//! counts what is allocated, so it holds no other test.

#![expect(
    unsafe_code,
    reason = "an allocator that counts has to be an allocator"
)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::sync::atomic::{AtomicUsize, Ordering};

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style as CellStyle};
use rayscope::lab::frames::scene;
use rayscope::method::Method;
use rayscope::render::Cell as Drawn;
use rayscope::render::{ColorDepth, Frame, Image, Look, Style, View};
use rayscope::scene::{PixelShape, Rays, Rgb, Size};
use rayscope::terminal::{Limits, Painter};

thread_local! {
    static TAKEN: Cell<usize> = const { Cell::new(0) };
}

/// The bytes that are in use, and the most that have been since it was last set.
static IN_USE: AtomicUsize = AtomicUsize::new(0);
static MOST: AtomicUsize = AtomicUsize::new(0);

/// The system's allocator, which counts how often this thread asks it for memory, and the bytes in use.
struct Counting;

// SAFETY: every call is handed on to the system's allocator as it is.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        TAKEN.set(TAKEN.get() + 1);
        let in_use = IN_USE.fetch_add(layout.size(), Ordering::Relaxed) + layout.size();
        MOST.fetch_max(in_use, Ordering::Relaxed);
        // SAFETY: the caller keeps the contract of `alloc`, which is the system's.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        IN_USE.fetch_sub(layout.size(), Ordering::Relaxed);
        // SAFETY: the memory is from `alloc` above, that is, from the system's allocator.
        unsafe { System.dealloc(memory, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Writes the cells of an image into a buffer.
fn put(image: &Image, buffer: &mut Buffer) {
    let color = |color: Option<Rgb>| color.map_or(Color::Reset, |Rgb(r, g, b)| Color::Rgb(r, g, b));
    for (cell, &Drawn { glyph, fg, bg }) in buffer.content.iter_mut().zip(&image.cells) {
        cell.set_char(glyph)
            .set_style(CellStyle::reset().fg(color(fg)).bg(color(bg)));
    }
}

#[test]
fn frames_that_follow_each_other_allocate_nothing() {
    let scenes = [1, 2].map(|seed| scene(2000, seed));
    let size = Size::new(80, 48);
    let rays = Rays::new(&scenes[0].camera, size, PixelShape::Aspect(1.0));
    let look = Look {
        style: Style::Half,
        depth: ColorDepth::Ansi256,
        ascii_only: false,
        coarse: false,
    };
    for method in [Method::Exact, Method::Kahan] {
        for view in View::ALL {
            let (mut frame, mut image) = (Frame::new(), Image::new());
            let (mut painter, area) = (Painter::default(), Rect::new(0, 0, 80, 24));
            let mut cells = Buffer::empty(area);
            let mut moved = scenes[0].clone();
            let mut round = || {
                for scene in &scenes {
                    frame.render(scene, &rays, method, view);
                    image.draw(&frame, scene, look);
                    put(&image, &mut cells);
                    painter.paint(&mut cells, None, Limits::default());
                }
                frame.render(&moved, &rays, method, view);
                for _ in 0..3 {
                    moved.bodies[1000].sphere.center.x += 0.01;
                    frame.render(&moved, &rays, method, view);
                    image.draw(&frame, &moved, look);
                    put(&image, &mut cells);
                    painter.paint(&mut cells, None, Limits::default());
                }
            };
            // The second round still finds room that only now is needed.
            round();
            round();
            let before = TAKEN.get();
            assert!(before > 0, "the allocator counts");
            round();
            assert_eq!(TAKEN.get(), before, "{method}, {}", view.name());
        }
    }
}

#[cfg(feature = "routine")]
mod routines {
    use super::*;
    use rayscope::routine::{LONGEST, Language, compile};

    /// A routine around these statements, and functions before it.
    fn with(functions: &str, body: &str) -> String {
        format!(
            "{functions}float f(vec3 ro, vec3 rd, vec3 ce, float ra) {{ float x = ra; {body} return x; }}"
        )
    }

    /// As many copies of a piece as the longest text has room for.
    fn full_of(piece: &str) -> String {
        piece.repeat((LONGEST - 200) / piece.len())
    }

    #[test]
    fn reading_a_routine_takes_bounded_memory() {
        let mut doubling = "float g0(float x) { return x * x; }\n".to_owned();
        for i in 1..60 {
            let sum = format!("g{0}(x) + g{0}(x)", i - 1);
            doubling += format!("float g{i}(float x) {{ return {sum}; }}\n").as_str();
        }
        let mut functions = String::new();
        for i in 0..1200 {
            functions += format!("vec3 h{i}(vec3 v) {{ return v * {i}.5; }}\n").as_str();
        }
        let texts = [
            with("", &full_of("x=x*x+ra;")),
            with("", &full_of("if(x<1.)x+=ra;")),
            with("", &full_of("{float y=x;x=y;}")),
            with("", &full_of("x+=dot(ro*rd,ce+x);")),
            with("", &full_of("for(int i=0;i<9;i++)x+=ra;")),
            with(&doubling, "x = g59(x);"),
            with(&doubling, "x = g11(x);"),
            with(&functions, "x = h7(ro).x;"),
            with(&full_of("struct S{vec3 a;};"), ""),
            with(&full_of("#define A x\n"), ""),
            full_of("("),
            full_of("\u{e4}"),
        ];
        let mut dearest = 0;
        for text in texts {
            let before = IN_USE.load(Ordering::Relaxed);
            MOST.store(before, Ordering::Relaxed);
            let read = compile(&text, Language::Glsl, false);
            let taken = MOST.load(Ordering::Relaxed) - before;
            let start: String = text.chars().take(60).collect();
            assert!(
                taken < 32 << 20,
                "{taken} bytes for {start}: {:?}",
                read.map(|_| "read")
            );
            dearest = dearest.max(taken);
        }
        // What would not be counted is no bound.
        assert!(dearest > 1 << 20, "{dearest}");
    }
}
