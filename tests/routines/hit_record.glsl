struct Hit {
    bool found;
    float t;
    vec3 normal;
};

// A record of the hit, with the normal there.
Hit trace(vec3 ro, vec3 rd, vec3 ce, float ra)
{
    Hit hit;
    hit.found = false;
    vec3 oc = ro - ce;
    float a = dot(rd, rd);
    float b = dot(oc, rd);
    float d = b * b - a * (dot(oc, oc) - ra * ra);
    if (d < 0.0) return hit;
    float t = (-b - sqrt(d)) / a;
    if (t <= 0.0) return hit;
    hit.found = true;
    hit.t = t;
    hit.normal = normalize(ro + t * rd - ce);
    return hit;
}
