dvec3 sub(dvec3 u, dvec3 v) { return u - v; }
dvec3 across(dvec3 u, dvec3 v) { return cross(u, v); }
double root(double x) { return sqrt(x); }
double choose(bool first, double one, double other) { return first ? one : other; }

vec2 intersect(vec3 origin, vec3 direction, vec3 center, float radius) {
    dvec3 p0 = dvec3(origin);
    dvec3 d = dvec3(direction);
    dvec3 cc = dvec3(center);
    double r = double(radius);
