//! Frames that follow each other allocate nothing. This binary counts, so it holds no other test.

#![expect(
    unsafe_code,
    reason = "an allocator that counts has to be an allocator"
)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

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

/// The system's allocator, which counts how often this thread asks it for memory.
struct Counting;

// SAFETY: every call is handed on to the system's allocator as it is.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        TAKEN.set(TAKEN.get() + 1);
        // SAFETY: the caller keeps the contract of `alloc`, which is the system's.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
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
