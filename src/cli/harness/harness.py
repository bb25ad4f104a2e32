"""Times your own intersection, and prints rays, answers and nanoseconds as CSV:

    python3 bench.py > answers.csv && rayscope grade answers.csv

Its checks of itself go to standard error. Python computes in binary64; what it prints is graded as binary32.
"""
import math
import struct
import sys
import time


# ---- your routine: both roots, or None if the ray p + t d misses the sphere ------------------------------------------
# A routine that gives one root gives it twice. The example is the textbook's.
def intersect(p, d, c, r):
    o = [p[i] - c[i] for i in range(3)]
    A = sum(x * x for x in d)
    B = 2.0 * sum(x * y for x, y in zip(d, o))
    C = sum(x * x for x in o) - r * r
    D = B * B - 4.0 * A * C
    if D < 0.0:
        return None
    s = math.sqrt(D)
    return (-B - s) / (2.0 * A), (-B + s) / (2.0 * A)
# ---- end of your routine ---------------------------------------------------------------------------------------------


RAYS, ROUNDS = 4096, 7


def single(x):
    """The nearest binary32."""
    return struct.unpack("f", struct.pack("f", x))[0]


def numbers():
    """Numbers from -1 to below 1, of 24 bits: the same rays on every machine."""
    state = 88172645463325252
    while True:
        state ^= state << 13 & (1 << 64) - 1
        state ^= state >> 7
        state ^= state << 17 & (1 << 64) - 1
        yield (state >> 40) / 8388608.0 - 1.0


def questions(count):
    number = numbers()
    for _ in range(count):
        r = single(1.25 + 0.75 * next(number))
        p, d, c = [0.0] * 3, [0.0] * 3, [0.0] * 3
        for i in range(3):
            c[i] = single(4.0 * next(number))
            p[i] = single(8.0 * next(number))
            d[i] = single(c[i] + 0.8 * r * next(number) - p[i])
        yield p, d, c, r


def timed(asked, times):
    """Nanoseconds a ray, the median of rounds; `times` calls a ray, 0 for the loop alone."""
    rounds = []
    for _ in range(ROUNDS):
        start = time.perf_counter_ns()
        for question in asked:
            for _ in range(times):
                intersect(*question)
        rounds.append((time.perf_counter_ns() - start) / len(asked))
    return sorted(rounds)[ROUNDS // 2]


def main():
    asked = list(questions(RAYS))
    empty, once, twice = (timed(asked, times) for times in range(3))
    ns = once - empty
    print(f"the loop alone takes {empty:.0f} ns a ray, with the routine {once:.0f}, with two calls {twice:.0f}", file=sys.stderr)
    if ns <= 0 or twice - empty < 1.2 * ns:
        print("these times can't be trusted: two calls should take about twice as long", file=sys.stderr)
    print("ox,oy,oz,dx,dy,dz,cx,cy,cz,r,class,near,far,ns")
    for p, d, c, r in asked:
        found = intersect(p, d, c, r)
        answer = "miss,," if found is None else f"hit,{found[0]:.9g},{found[1]:.9g}"
        print(",".join(f"{x:.9g}" for x in [*p, *d, *c, r]) + f",{answer},{ns:.3f}")


main()
