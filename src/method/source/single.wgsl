fn sub(u: vec3<f32>, v: vec3<f32>) -> vec3<f32> { return u - v; }
fn scale(k: f32, v: vec3<f32>) -> vec3<f32> { return v * k; }
fn root(x: f32) -> f32 { return sqrt(x); }
fn fused(x: f32, y: f32, z: f32) -> f32 { return fma(x, y, z); }
fn fused_dot(u: vec3<f32>, v: vec3<f32>) -> f32 { return fma(u.z, v.z, fma(u.x, v.x, u.y * v.y)); }
fn choose(first: bool, one: f32, other: f32) -> f32 { return select(other, one, first); }

fn intersect(origin: vec3<f32>, direction: vec3<f32>, center: vec3<f32>, radius: f32) -> vec2<f32> {
