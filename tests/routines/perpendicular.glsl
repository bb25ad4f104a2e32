// r² less the square of the distance of the line: far spheres keep their bits.
vec2 hit(vec3 ro, vec3 rd, vec3 ce, float r)
{
    vec3 f = ro - ce;
    float a = dot(rd, rd);
    float b = dot(f, rd);
    vec3 l = f - (b / a) * rd;                    // from the centre to the nearest point of the line
    float h = r * r - dot(l, l);
    if (h < 0.0) return vec2(-1.0);
    float s = sqrt(h / a);
    float m = -b / a;
    return vec2(m - s, m + s);
}
