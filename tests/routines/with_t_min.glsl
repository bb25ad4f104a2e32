// The first root in an interval, as a tracer asks for it.
const float NO_HIT = 1e20;

float trace(vec3 ro, vec3 rd, vec3 center, float radius, float tMin, float tMax)
{
    vec3 oc = ro - center;
    float a = dot(rd, rd);
    float b = dot(oc, rd);
    float c = dot(oc, oc) - radius * radius;
    float d = b * b - a * c;
    float found = NO_HIT;
    if (d >= 0.0) {
        float s = sqrt(d);
        float roots[2];
        roots[0] = (-b - s) / a;
        roots[1] = (-b + s) / a;
        if (roots[0] > tMin && roots[0] < tMax) found = roots[0];
        else if (roots[1] > tMin && roots[1] < tMax) found = roots[1];
    }
    return found;
}
