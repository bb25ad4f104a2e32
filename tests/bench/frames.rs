//! Times whole frames.
fn main() {
    rayscope::lab::frames::sketch();
}
