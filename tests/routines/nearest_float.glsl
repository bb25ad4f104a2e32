// The least t above 0, or -1.
float sq(float x) { return x * x; }

float nearest(vec3 ro, vec3 rd, vec3 ce, float ra)
{
    vec3 oc = ro - ce;
    float a = dot(rd, rd);
    float b = dot(oc, rd);
    float h = sq(b) - a * (dot(oc, oc) - sq(ra));
    if (h < 0.0) return -1.0;
    h = sqrt(h);
    float near = (-b - h) / a;
    float far = (-b + h) / a;
    return near > 0.0 ? near : far > 0.0 ? far : -1.0;
}
