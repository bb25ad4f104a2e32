// The anchor of docs/plan.md: the scenes of `rayscope bench --frames`, drawn by Embree 3 on one thread.
//
// Every sphere moves in every frame, so each frame commits the spheres anew, builds its acceleration
// structure and traces a ray for each pixel, then shades what is hit by a headlight. Not part of the
// crate; docs/plan.md has the line that compiles it.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <embree3/rtcore.h>

namespace {

// SplitMix64 and the draws of src/lab/random.rs: the same scenes, bit for bit.
struct Random {
    uint64_t state;

    uint64_t bits() {
        state += 0x9e3779b97f4a7c15;
        uint64_t z = state;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return z ^ (z >> 31);
    }

    double uniform(double least, double end) {
        return least + double(bits() >> 11) * 0x1p-53 * (end - least);
    }
};

struct Ball {
    float x, y, z, r;
};

// Those of src/lab/frames.rs.
std::vector<Ball> scene(size_t count, uint64_t seed) {
    Random random{seed};
    const double half = 10, spacing = 2 * half / std::cbrt(double(count));
    std::vector<Ball> balls(count);
    for (auto& ball : balls) {
        const double radius = spacing * random.uniform(0.2, 0.45), reach = half - radius;
        ball.x = float(random.uniform(-reach, reach));
        ball.y = float(random.uniform(-reach, reach));
        ball.z = float(random.uniform(-reach, reach));
        ball.r = float(radius);
    }
    return balls;
}

constexpr unsigned WIDTH = 200, HEIGHT = 120;
constexpr int PACKET = 8;

struct Picture {
    RTCScene scene;
    RTCGeometry geometry;
    Ball* room;
    size_t count;
    std::vector<float> brightness = std::vector<float>(WIDTH * HEIGHT);
    size_t seen = 0;

    Picture(RTCDevice device, size_t count) : count(count) {
        scene = rtcNewScene(device);
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_DYNAMIC);
        rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
        geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
        rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_LOW);
        room = static_cast<Ball*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, sizeof(Ball), count));
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
    }

    void rebuild(const std::vector<Ball>& balls) {
        std::copy(balls.begin(), balls.end(), room);
        rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
        rtcCommitGeometry(geometry);
        rtcCommitScene(scene);
    }

    // The eye at (0, 0, 30) looks along -z, 45 degrees high.
    static void direction(unsigned x, unsigned y, float& dx, float& dy) {
        const double step = 2 * std::tan(M_PI / 8) / HEIGHT;
        dx = float((x - (WIDTH - 1) / 2.0) * step);
        dy = float(-(y - (HEIGHT - 1) / 2.0) * step);
    }

    static float headlight(float dx, float dy, float nx, float ny, float nz) {
        const float dot = dx * nx + dy * ny - nz;
        return 0.12f + 0.88f * std::min(std::fabs(dot) / std::sqrt((dx * dx + dy * dy + 1) *
                                                                  (nx * nx + ny * ny + nz * nz)),
                                        1.0f);
    }

    void trace_single() {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        for (unsigned y = 0; y < HEIGHT; ++y) {
            for (unsigned x = 0; x < WIDTH; ++x) {
                RTCRayHit ray{};
                direction(x, y, ray.ray.dir_x, ray.ray.dir_y);
                ray.ray.dir_z = -1;
                ray.ray.org_z = 30;
                ray.ray.tfar = INFINITY;
                ray.ray.mask = -1;
                ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
                rtcIntersect1(scene, &context, &ray);
                const bool hit = ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
                brightness[y * WIDTH + x] =
                    hit ? headlight(ray.ray.dir_x, ray.ray.dir_y, ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z)
                        : 0;
                seen += hit;
            }
        }
    }

    void trace_packets() {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        alignas(32) int valid[PACKET];
        std::fill(valid, valid + PACKET, -1);
        for (unsigned y = 0; y < HEIGHT; ++y) {
            for (unsigned x = 0; x < WIDTH; x += PACKET) {
                RTCRayHit8 rays{};
                for (int i = 0; i < PACKET; ++i) {
                    direction(x + i, y, rays.ray.dir_x[i], rays.ray.dir_y[i]);
                    rays.ray.dir_z[i] = -1;
                    rays.ray.org_z[i] = 30;
                    rays.ray.tfar[i] = INFINITY;
                    rays.ray.mask[i] = -1;
                    rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
                }
                rtcIntersect8(valid, scene, &context, &rays);
                for (int i = 0; i < PACKET; ++i) {
                    const bool hit = rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
                    brightness[y * WIDTH + x + i] =
                        hit ? headlight(rays.ray.dir_x[i], rays.ray.dir_y[i], rays.hit.Ng_x[i],
                                        rays.hit.Ng_y[i], rays.hit.Ng_z[i])
                            : 0;
                    seen += hit;
                }
            }
        }
    }
};

template <typename Run>
double median_ms(int rounds, Run run) {
    std::vector<double> times;
    for (int round = -2; round < rounds; ++round) {
        const auto start = std::chrono::steady_clock::now();
        run(round & 1);
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
        if (round >= 0) {
            times.push_back(taken.count());
        }
    }
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
}

}  // namespace

int main() {
    RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
    std::printf("Embree %s, one thread, %u x %u pixels, median ms of a frame\n", RTC_VERSION_STRING,
                WIDTH, HEIGHT);
    std::printf("%9s %10s %10s %10s %8s\n", "spheres", "single", "packets", "rebuild", "seen");
    for (size_t count = 1; count <= 1000000; count *= 10) {
        const std::vector<Ball> scenes[] = {scene(count, 1), scene(count, 2)};
        Picture picture(device, count);
        const int rounds = count > 10000 ? 9 : 41;
        const double single = median_ms(rounds, [&](int i) {
            picture.rebuild(scenes[i]);
            picture.trace_single();
        });
        const double packets = median_ms(rounds, [&](int i) {
            picture.rebuild(scenes[i]);
            picture.trace_packets();
        });
        const double rebuild = median_ms(rounds, [&](int i) { picture.rebuild(scenes[i]); });
        picture.rebuild(scenes[0]);
        picture.seen = 0;
        picture.trace_single();
        std::printf("%9zu %10.3f %10.3f %10.3f %8zu\n", count, single, packets, rebuild, picture.seen);
    }
}
