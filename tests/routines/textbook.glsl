// A quadratic as in school: B² - 4AC, and both roots.
vec2 intersect(vec3 origin, vec3 direction, vec3 center, float radius) {
    vec3 o = origin - center;                     // from the centre to where the ray starts
    float a = dot(direction, direction);          // what multiplies t²
    float b = 2.0 * dot(direction, o);            // what multiplies t
    float c = dot(o, o) - radius * radius;        // what is left without t
    float discriminant = b * b - 4.0 * a * c;
    if (discriminant < 0.0) return vec2(-1.0);    // no point in common
    float root = sqrt(discriminant);
    return vec2((-b - root) / (2.0 * a), (-b + root) / (2.0 * a));
}
