// The number of roots, and the roots where they are written to.
int solve(vec3 p0, vec3 d, vec3 c, float r, out float t0, out float t1)
{
    vec3 o = p0 - c;
    float A = dot(d, d), B = 2.0 * dot(d, o), C = dot(o, o) - r * r;
    float D = B * B - 4.0 * A * C;
    t0 = t1 = 0.0;
    if (D < 0.0) return 0;
    t0 = (-B - sqrt(D)) / (2.0 * A);
    t1 = (-B + sqrt(D)) / (2.0 * A);
    return D == 0.0 ? 1 : 2;
}
