/* The tutorial's code, with the roots that it leaves to its reader, as a compiler is given it. What the
   compiler fuses is what the method `contracted` is about. Reads rows of ten binary32 in hexadecimal,
   writes class and roots. gcc -O2 -mfma contracted.c -lm */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

typedef struct { float x, y, z; } vector;
typedef struct { vector start, dir; } ray;
typedef struct { vector pos; float radius; } sphere;

static vector vectorSub(vector *v1, vector *v2) {
  vector result = { v1->x - v2->x, v1->y - v2->y, v1->z - v2->z };
  return result;
}

static float vectorDot(vector *v1, vector *v2) {
  return v1->x * v2->x + v1->y * v2->y + v1->z * v2->z;
}

static const char *intersectRaySphere(ray *r, sphere *s, float *near, float *far) {
  float A = vectorDot(&r->dir, &r->dir);
  vector dist = vectorSub(&r->start, &s->pos);
  float B = 2 * vectorDot(&r->dir, &dist);
  float C = vectorDot(&dist, &dist) - (s->radius * s->radius);
  float discr = B * B - 4 * A * C;
  if (discr < 0) return "miss";
  if (!(discr >= 0)) return "nan";
  float root = sqrtf(discr);
  *near = (-B - root) / (2 * A);
  *far = (-B + root) / (2 * A);
  return discr == 0 ? "tangent" : "secant";
}

static float of(uint32_t bits) { float x; memcpy(&x, &bits, sizeof x); return x; }
static uint32_t bits(float x) { uint32_t b; memcpy(&b, &x, sizeof b); return b; }

int main(void) {
  unsigned b[10];
  for (;;) {
    for (int i = 0; i < 10; i++) if (scanf("%x", &b[i]) != 1) return 0;
    ray r = { { of(b[0]), of(b[1]), of(b[2]) }, { of(b[3]), of(b[4]), of(b[5]) } };
    sphere s = { { of(b[6]), of(b[7]), of(b[8]) }, of(b[9]) };
    float near = NAN, far = NAN;
    const char *class = intersectRaySphere(&r, &s, &near, &far);
    /* A root of -0 is the 0 it equals; any NaN is a NaN. */
    near += 0.0f, far += 0.0f;
    printf("%s %08x %08x\n", class, isnan(near) ? 0x7fc00000u : bits(near), isnan(far) ? 0x7fc00000u : bits(far));
  }
}
