// The textbook in the language of WebGPU.
fn intersect(origin: vec3<f32>, direction: vec3<f32>, center: vec3<f32>, radius: f32) -> vec2<f32> {
    let o = origin - center;                     // from the centre to where the ray starts
    let a = dot(direction, direction);
    let b = 2.0 * dot(direction, o);
    let c = dot(o, o) - radius * radius;
    let discriminant = b * b - 4.0 * a * c;
    if (discriminant < 0.0) { return vec2<f32>(-1.0, -1.0); }
    let root = sqrt(discriminant);
    return vec2<f32>((-b - root) / (2.0 * a), (-b + root) / (2.0 * a));
}
