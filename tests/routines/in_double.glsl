// In binary64 inside.
vec2 sphereDouble(vec3 ro, vec3 rd, vec3 ce, float ra)
{
    dvec3 oc = dvec3(ro) - dvec3(ce);
    dvec3 d = dvec3(rd);
    double a = dot(d, d);
    double b = dot(oc, d);
    double r = double(ra);
    double h = b * b - a * (dot(oc, oc) - r * r);
    if (h < double(0.0)) return vec2(-1.0);
    h = sqrt(h);
    return vec2(float((-b - h) / a), float((-b + h) / a));
}
