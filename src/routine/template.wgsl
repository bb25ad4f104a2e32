// The tutorial's function:
// does the ray meet the sphere?
fn intersectRaySphere(
    start: vec3f, dir: vec3f,
    pos: vec3f, radius: f32
) -> bool {
    let o = start - pos;
    let A = dot(dir, dir);
    let B = 2.0 * dot(dir, o);
    let C = dot(o, o)
        - radius * radius;
    let D = B * B
        - 4.0 * A * C;
    return D >= 0.0;
}
