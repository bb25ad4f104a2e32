// L, tca, thc: the legs of a right triangle.
bool intersect(vec3 orig, vec3 dir, vec3 center, float radius, out float t0, out float t1)
{
    vec3 L = center - orig;
    float tca = dot(L, dir);
    float d2 = dot(L, L) - tca * tca;
    float radius2 = radius * radius;
    if (d2 > radius2) return false;
    float thc = sqrt(radius2 - d2);
    t0 = tca - thc;
    t1 = tca + thc;
    return true;
}
