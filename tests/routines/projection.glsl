// Project the centre on the ray, and look how far it is from there.
float sphere(vec3 ro, vec3 rd, vec4 sph)
{
    vec3 d = normalize(rd);
    float along = dot(sph.xyz - ro, d);          // where the ray comes closest
    vec3 closest = ro + along * d;
    float gap = distance(closest, sph.xyz);      // how close that is
    if (gap > sph.w) return -1.0;
    float inside = sqrt(sph.w * sph.w - gap * gap);
    float t = along - inside;
    return t / length(rd);
}
