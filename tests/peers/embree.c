/* The peer of bench-crowd: the same picture of spheres over a floor by Embree 3, a camera and a
 * shadow ray a sample; prints CPU seconds on one thread.
 *
 *   bench-crowd SCENE spheres n=1000 | peer-embree SAMPLES */
#include <embree3/rtcore.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define WIDTH 360
#define LINES 243

typedef struct ball {
    float x, y, z, radius, color[3];
} ball;

static double cpu_s(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static float drawn(unsigned *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return (float)(*seed >> 8) * 0x1p-24f;
}

static ball *read_balls(size_t *count) {
    size_t room = 1024;
    ball *balls = malloc(room * sizeof *balls), *grown = balls;
    *count = 0;
    while (balls && fread(&balls[*count], sizeof *balls, 1, stdin) == 1)
        if (++*count == room) {
            room *= 2;
            grown = realloc(balls, room * sizeof *balls);
            if (!grown) free(balls);
            balls = grown;
        }
    return balls;
}

static void add_balls(RTCDevice device, RTCScene scene, const ball *balls, size_t count) {
    RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    float *to =
        rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, count);
    for (size_t n = 0; n < count; n++)
        for (size_t k = 0; k < 4; k++) to[4 * n + k] = (&balls[n].x)[k];
    rtcCommitGeometry(g);
    rtcAttachGeometry(scene, g);
    rtcReleaseGeometry(g);
}

static void add_floor(RTCDevice device, RTCScene scene) {
    static const float corner[4][3] = {
        {-1e4f, -1, -1e4f}, {1e4f, -1, -1e4f}, {1e4f, -1, 1e4f}, {-1e4f, -1, 1e4f}};
    static const unsigned index[6] = {0, 1, 2, 0, 2, 3};
    RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    float *at = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 4);
    unsigned *of =
        rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, 2);
    for (int n = 0; n < 12; n++) at[n] = corner[n / 3][n % 3];
    for (int n = 0; n < 6; n++) of[n] = index[n];
    rtcCommitGeometry(g);
    rtcAttachGeometry(scene, g);
    rtcReleaseGeometry(g);
}

/* From the eye {0, 5, 13} to {0, 0.4, 0}, 42 degrees high. */
static void aim(float x, float y, struct RTCRayHit *r) {
    const float length = sqrtf(4.6f * 4.6f + 13 * 13), half = 0.383864f;
    const float forward[2] = {-4.6f / length, -13 / length}; /* y, z */
    float a = (2 * x - WIDTH) / LINES * half, b = (1 - 2 * y / LINES) * half;
    r->ray = (struct RTCRay){.org_y = 5, .org_z = 13, .tfar = INFINITY, .mask = 0xffffffff};
    r->ray.dir_x = a;
    r->ray.dir_y = forward[0] - b * forward[1];
    r->ray.dir_z = forward[1] + b * forward[0];
    r->hit.geomID = RTC_INVALID_GEOMETRY_ID;
}

/* From what was met to the light; false: it faces away. */
static int to_light(const struct RTCRayHit *r, struct RTCRay *out) {
    float n[3] = {r->hit.Ng_x, r->hit.Ng_y, r->hit.Ng_z};
    float along = n[0] * r->ray.dir_x + n[1] * r->ray.dir_y + n[2] * r->ray.dir_z;
    float off = (along > 0 ? -1e-4f : 1e-4f) / sqrtf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    *out = (struct RTCRay){.tfar = 1, .mask = 0xffffffff};
    out->org_x = r->ray.org_x + r->ray.tfar * r->ray.dir_x + off * n[0];
    out->org_y = r->ray.org_y + r->ray.tfar * r->ray.dir_y + off * n[1];
    out->org_z = r->ray.org_z + r->ray.tfar * r->ray.dir_z + off * n[2];
    out->dir_x = 8 - out->org_x, out->dir_y = 14 - out->org_y, out->dir_z = 9 - out->org_z;
    return (n[0] * out->dir_x + n[1] * out->dir_y + n[2] * out->dir_z) * off > 0;
}

static int sample(RTCScene scene, float x, float y, double *sum) {
    struct RTCIntersectContext context;
    struct RTCRayHit hit;
    struct RTCRay shadow;
    rtcInitIntersectContext(&context);
    aim(x, y, &hit);
    rtcIntersect1(scene, &context, &hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID || !to_light(&hit, &shadow)) return 1;
    rtcOccluded1(scene, &context, &shadow);
    *sum += shadow.tfar > 0;
    return 2;
}

int main(int count, char **argument) {
    int samples = count > 1 ? atoi(argument[1]) : 4;
    size_t balls = 0;
    unsigned seed = 1;
    ball *all = read_balls(&balls);
    if (!all || !balls) return 1;
    RTCDevice device = rtcNewDevice("threads=1");
    RTCScene scene = rtcNewScene(device);
    add_balls(device, scene, all, balls);
    add_floor(device, scene);
    double start = cpu_s(), sum = 0;
    rtcCommitScene(scene);
    double built = cpu_s();
    long rays = 0;
    for (int n = 0; n < WIDTH * LINES * samples; n++) {
        int cell = n / samples;
        float x = (float)(cell % WIDTH) + drawn(&seed),
              y = (float)(cell / WIDTH) + drawn(&seed);
        rays += sample(scene, x, y, &sum);
    }
    printf("build %.4f trace %.4f rays %ld lit %.0f\n", built - start, cpu_s() - built, rays,
           sum);
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
    free(all);
    return 0;
}
