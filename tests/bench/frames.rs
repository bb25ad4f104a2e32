//! Times whole frames.
use rayscope::method::Method;
use rayscope::render::{Frame, View};
use rayscope::scene::{PixelShape, Rays, Size};
fn main() {
    let args: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with("--"))
        .collect();
    if args.is_empty() {
        rayscope::lab::frames::sketch();
        return;
    }
    let n: usize = args[0].parse().unwrap();
    let view = View::by_name(&args[1]).unwrap();
    let rounds: usize = args[2].parse().unwrap();
    let scenes = [1, 2].map(|seed| rayscope::lab::frames::scene(n, seed));
    let rays = Rays::new(
        &scenes[0].camera,
        Size::new(200, 120),
        PixelShape::Aspect(1.0),
    );
    let mut frame = Frame::new();
    for i in 0..rounds {
        frame.render(&scenes[i % 2], &rays, Method::Exact, view);
    }
    println!("{}", frame.plan());
}
