// q = -(b + sign(b) s): the sum that does not cancel; the other root from the product of both.
vec2 sphere_q(vec3 ro, vec3 rd, vec3 ce, float ra)
{
    vec3 oc = ro - ce;
    float a = dot(rd, rd);
    float b = dot(oc, rd);
    float c = dot(oc, oc) - ra * ra;
    float d = b * b - a * c;
    if (d < 0.0) return vec2(-1.0);
    float s = sqrt(d);
    float q = -(b + (b < 0.0 ? -s : s));
    if (q == 0.0) return vec2(q / a, q / a);
    float one = q / a;
    float other = c / q;
    return vec2(min(one, other), max(one, other));
}
