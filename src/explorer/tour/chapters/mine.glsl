bool isHit(float D) {
    return D >
        0.0;
}

// The tutorial's function
bool intersectRaySphere(
    vec3 start, vec3 dir,
    vec3 pos, float radius
) {
    vec3 o = start - pos;
    float A = dot(dir, dir);
    float B = 2.0 * dot(dir, o);
    float C = dot(o, o)
        - radius * radius;
    float D = B * B
        - 4.0 * A * C;
    return isHit(D);
}
