struct Ray { vec3 start; vec3 dir; };
struct Sphere { vec3 pos; float radius; };

// Whether the line meets the sphere: nothing more.
bool intersectRaySphere(Ray r, Sphere s)
{
    float A = dot(r.dir, r.dir);
    vec3 dist = r.start - s.pos;
    float B = 2.0 * dot(r.dir, dist);
    float C = dot(dist, dist) - (s.radius * s.radius);
    float discr = B * B - 4.0 * A * C;
    if (discr < 0.0)
        return false;
    else
        return true;
}
