#version 300 es
precision highp float;

struct Ray { vec3 start; vec3 dir; };

// The same with half of B, which saves two multiplications.
bool hitSphere(vec3 center, float radius, Ray ray, out float t0, out float t1) {
    vec3 oc = ray.start - center;
    float a = dot(ray.dir, ray.dir);
    float half_b = dot(oc, ray.dir);
    float c = dot(oc, oc) - radius * radius;
    float d = half_b * half_b - a * c;
    if (d < 0.0) {
        return false;
    }
    float s = sqrt(d);
    t0 = (-half_b - s) / a;
    t1 = (-half_b + s) / a;
    return true;
}
