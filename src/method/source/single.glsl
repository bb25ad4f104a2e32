vec3 sub(vec3 u, vec3 v) { return u - v; }
vec3 scale(float k, vec3 v) { return v * k; }
float root(float x) { return sqrt(x); }
float fused(float x, float y, float z) { return fma(x, y, z); }
float fused_dot(vec3 u, vec3 v) { return fma(u.z, v.z, fma(u.x, v.x, u.y * v.y)); }
float choose(bool first, float one, float other) { return first ? one : other; }

vec2 intersect(vec3 origin, vec3 direction, vec3 center, float radius) {
