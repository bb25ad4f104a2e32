// Step along the ray by how far the sphere is, as a ray marcher does.
float march(vec3 ro, vec3 rd, vec3 ce, float ra)
{
    float t = 0.0;
    vec3 d = normalize(rd);
    for (int i = 0; i < 64; i++) {
        vec3 p = ro + t * d;
        float gap = length(p - ce) - ra;
        if (gap < 0.0001) return t / length(rd);
        t += gap;
        if (t > 1000.0) break;
    }
    return -1.0;
}
