// Every product goes into the sum that uses it: rounded once.
vec2 sphereFma(vec3 ro, vec3 rd, vec3 ce, float ra)
{
    vec3 oc = ro - ce;
    float a = fma(rd.z, rd.z, fma(rd.y, rd.y, rd.x * rd.x));
    float b = fma(oc.z, rd.z, fma(oc.y, rd.y, oc.x * rd.x));
    float c = fma(-ra, ra, fma(oc.z, oc.z, fma(oc.y, oc.y, oc.x * oc.x)));
    float w = a * c;
    float e = fma(a, c, -w);
    float d = fma(b, b, -w) - e;                  // the difference of two products, by Kahan
    if (d < 0.0) return vec2(-1.0);
    float s = sqrt(d);
    return vec2((-b - s) / a, (-b + s) / a);
}
