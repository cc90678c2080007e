// Rays a second of Embree 4 on the scenes of scenes.h, one thread: `cargo xtask bench kernel` compiles and runs this.
//
//   bench SCENE REPEATS QUALITY    SCENE: terrain, cave, soup, spheres, user-spheres; QUALITY: low, medium, high
//
// With 0 repeats the tree is built and no ray is sent. Prints one JSON object a line, as benches/kernel does.
#include "scenes.h"
#include <embree4/rtcore.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <limits>
#include <string>
#if defined(__SSE__)
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

static const float INFINITE = std::numeric_limits<float>::infinity();

// What is measured.
static std::string scene_name, quality_name;
static Mesh mesh;
static std::vector<float> balls;
static bool has_spheres, are_users;
// Bytes that Embree holds, as it tells.
static std::atomic<size_t> held;

static double processor_time() {
  timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return time.tv_sec + 1e-9 * time.tv_nsec;
}

static void print(const char* measure, const std::string& rest) {
  const char* kind = are_users ? "user " : "";
  printf("{\"program\": \"Embree\", \"variant\": \"%s%s\", \"scene\": \"%s\", \"measure\": \"%s\", %s}\n", kind,
         quality_name.c_str(), has_spheres ? "spheres" : scene_name.c_str(), measure, rest.c_str());
}

template <class... Values>
static std::string text(const char* format, Values... values) {
  char buffer[256];
  snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

// A ball as geometry of the user's.

static void user_bounds(const RTCBoundsFunctionArguments* arguments) {
  const float* s = &balls[4 * arguments->primID];
  RTCBounds* bounds = arguments->bounds_o;
  bounds->lower_x = s[0] - s[3], bounds->lower_y = s[1] - s[3], bounds->lower_z = s[2] - s[3];
  bounds->upper_x = s[0] + s[3], bounds->upper_y = s[1] + s[3], bounds->upper_z = s[2] + s[3];
}

// Where a ray of N meets a ball, from its point nearest to the center; -1 if it does not.
static inline float user_hit(const float* s, RTCRayN* rays, unsigned N, unsigned i) {
  float qx = RTCRayN_org_x(rays, N, i) - s[0], qy = RTCRayN_org_y(rays, N, i) - s[1], qz = RTCRayN_org_z(rays, N, i) - s[2];
  float dx = RTCRayN_dir_x(rays, N, i), dy = RTCRayN_dir_y(rays, N, i), dz = RTCRayN_dir_z(rays, N, i);
  float squared = dx * dx + dy * dy + dz * dz, nearest = -(qx * dx + qy * dy + qz * dz) / squared;
  float ax = qx + nearest * dx, ay = qy + nearest * dy, az = qz + nearest * dz;
  float discriminant = s[3] * s[3] - (ax * ax + ay * ay + az * az);
  if (discriminant < 0) return -1;
  float half = std::sqrt(discriminant / squared), from = RTCRayN_tnear(rays, N, i), to = RTCRayN_tfar(rays, N, i);
  if (nearest - half > from && nearest - half < to) return nearest - half;
  if (nearest + half > from && nearest + half < to) return nearest + half;
  return -1;
}

static void user_intersect(const RTCIntersectFunctionNArguments* arguments) {
  RTCRayN* rays = RTCRayHitN_RayN(arguments->rayhit, arguments->N);
  RTCHitN* hits = RTCRayHitN_HitN(arguments->rayhit, arguments->N);
  for (unsigned i = 0; i < arguments->N; i++) {
    float t = arguments->valid[i] ? user_hit(&balls[4 * arguments->primID], rays, arguments->N, i) : -1;
    if (t < 0) continue;
    RTCRayN_tfar(rays, arguments->N, i) = t;
    RTCHitN_primID(hits, arguments->N, i) = arguments->primID;
    RTCHitN_geomID(hits, arguments->N, i) = arguments->geomID;
  }
}

static void user_occluded(const RTCOccludedFunctionNArguments* arguments) {
  for (unsigned i = 0; i < arguments->N; i++)
    if (arguments->valid[i] && user_hit(&balls[4 * arguments->primID], arguments->ray, arguments->N, i) >= 0)
      RTCRayN_tfar(arguments->ray, arguments->N, i) = -INFINITE;
}

// Building.

template <class T>
static void fill(RTCGeometry geometry, RTCBufferType type, RTCFormat format, size_t stride, const std::vector<T>& values) {
  void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, stride, values.size() * sizeof(T) / stride);
  memcpy(buffer, values.data(), values.size() * sizeof(T));
}

static RTCGeometry geometry(RTCDevice device) {
  if (are_users) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, balls.size() / 4);
    rtcSetGeometryBoundsFunction(geometry, user_bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, user_intersect);
    rtcSetGeometryOccludedFunction(geometry, user_occluded);
    return geometry;
  }
  if (has_spheres) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    fill(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, 16, balls);
    return geometry;
  }
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  fill(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 12, mesh.positions);
  fill(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, 12, mesh.triangles);
  return geometry;
}

// A scene, and what it took to build: without the lists, which Embree wants to be copied before.
struct Built {
  RTCScene scene;
  double seconds;
  size_t bytes, list_bytes;
};

static Built build(RTCDevice device, RTCBuildQuality quality) {
  size_t before = held;
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneBuildQuality(scene, quality);
  // Without it rays may slip through between triangles.
  if (quality_name == "robust") rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry things = geometry(device);
  rtcSetGeometryBuildQuality(things, quality);
  rtcCommitGeometry(things);
  rtcAttachGeometry(scene, things);
  rtcReleaseGeometry(things);
  // User geometry leaves its numbers where they are.
  size_t lists = are_users ? balls.size() * sizeof(float) : held - before, with_lists = held;
  double start = processor_time();
  rtcCommitScene(scene);
  return {scene, processor_time() - start, held - with_lists, lists};
}

// Rays.

static const unsigned NOTHING = ~0u;

struct Found {
  size_t hits = 0;
  double distances = 0;
  std::vector<unsigned> things;  // what each ray hit; only for rays that ask
};

static void set_ray(RTCRay& to, const Ray& from, float t_max) {
  to.org_x = from.origin[0], to.org_y = from.origin[1], to.org_z = from.origin[2];
  to.dir_x = from.direction[0], to.dir_y = from.direction[1], to.dir_z = from.direction[2];
  to.tnear = 0, to.tfar = t_max, to.time = 0, to.mask = ~0u, to.flags = 0, to.id = 0;
}

static Found closest(RTCScene scene, const std::vector<Ray>& rays, bool keep) {
  Found found;
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  for (const Ray& from : rays) {
    RTCRayHit ray;
    set_ray(ray.ray, from, INFINITE);
    ray.hit.geomID = ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &ray, &arguments);
    bool hit = ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    found.hits += hit;
    if (hit) found.distances += ray.ray.tfar;
    if (keep) found.things.push_back(hit ? ray.hit.primID : NOTHING);
  }
  return found;
}

static Found any(RTCScene scene, const std::vector<Ray>& rays, float t_max) {
  Found found;
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  for (const Ray& from : rays) {
    RTCRay ray;
    set_ray(ray, from, t_max);
    rtcOccluded1(scene, &ray, &arguments);
    found.hits += ray.tfar < 0;
  }
  return found;
}

// Eight rays from the list, the last of which may be fewer.
static void set_rays(RTCRay8& to, int* valid, const std::vector<Ray>& rays, size_t first, float t_max) {
  for (size_t i = 0; i < 8; i++) {
    bool is_used = first + i < rays.size();
    const Ray& from = rays[is_used ? first + i : first];
    valid[i] = is_used ? -1 : 0;
    to.org_x[i] = from.origin[0], to.org_y[i] = from.origin[1], to.org_z[i] = from.origin[2];
    to.dir_x[i] = from.direction[0], to.dir_y[i] = from.direction[1], to.dir_z[i] = from.direction[2];
    to.tnear[i] = 0, to.tfar[i] = t_max, to.time[i] = 0, to.mask[i] = ~0u, to.flags[i] = 0, to.id[i] = 0;
  }
}

static Found closest8(RTCScene scene, const std::vector<Ray>& rays) {
  Found found;
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  for (size_t first = 0; first < rays.size(); first += 8) {
    alignas(32) RTCRayHit8 packet;
    alignas(32) int valid[8];
    set_rays(packet.ray, valid, rays, first, INFINITE);
    for (int i = 0; i < 8; i++) packet.hit.geomID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect8(valid, scene, &packet, &arguments);
    for (int i = 0; i < 8; i++)
      if (valid[i] && packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) {
        found.hits++;
        found.distances += packet.ray.tfar[i];
      }
  }
  return found;
}

static Found any8(RTCScene scene, const std::vector<Ray>& rays, float t_max, bool is_coherent) {
  Found found;
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  if (is_coherent) arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  for (size_t first = 0; first < rays.size(); first += 8) {
    alignas(32) RTCRay8 packet;
    alignas(32) int valid[8];
    set_rays(packet, valid, rays, first, t_max);
    rtcOccluded8(valid, scene, &packet, &arguments);
    for (int i = 0; i < 8; i++) found.hits += valid[i] && packet.tfar[i] < 0;
  }
  return found;
}

// One pass to warm up, then the median of the others.
template <class Trace>
static void measure(const char* kind, const char* way, const std::vector<Ray>& rays, int repeats, Trace trace) {
  Found found = trace(rays);
  std::vector<double> seconds;
  for (int i = 0; i < repeats; i++) {
    double start = processor_time();
    found = trace(rays);
    seconds.push_back(processor_time() - start);
  }
  std::sort(seconds.begin(), seconds.end());
  double rate = rays.size() / seconds[seconds.size() / 2] * 1e-6;
  print("rays", text("\"rays\": \"%s\", \"way\": \"%s\", \"count\": %zu, \"million_a_second\": %.6f, \"hits\": %zu, "
                     "\"distances\": %.12g",
                     kind, way, rays.size(), rate, found.hits, found.distances));
}

static void measure_all(RTCScene scene, int repeats) {
  const View& view = scene_name == "terrain" ? OVER_TERRAIN : scene_name == "cave" ? WITHIN_CAVE : INTO_CUBE;
  std::vector<Ray> eye = primary(view), bounced, shadows;
  std::vector<unsigned> things = closest(scene, eye, true).things;
  for (size_t i = 0; i < eye.size(); i++) {
    if (things[i] == NOTHING) continue;
    Point point = has_spheres ? on_sphere(&balls[4 * things[i]], eye[i]) : on_triangle(mesh, things[i], eye[i]);
    bounced.push_back(bounce(i, point));
    shadows.push_back(shadow(view, point));
  }
  auto single = [&](const std::vector<Ray>& rays) { return closest(scene, rays, false); };
  measure("primary", "single", eye, repeats, single);
  measure("primary", "packets, coherent", eye, repeats, [&](auto& rays) { return closest8(scene, rays); });
  measure("bounce", "single", bounced, repeats, single);
  measure("bounce any", "single", bounced, repeats, [&](auto& rays) { return any(scene, rays, INFINITE); });
  measure("shadow", "single", shadows, repeats, [&](auto& rays) { return any(scene, rays, 1.0f); });
  measure("shadow", "packets", shadows, repeats, [&](auto& rays) { return any8(scene, rays, 1.0f, false); });
  measure("shadow", "packets, coherent", shadows, repeats, [&](auto& rays) { return any8(scene, rays, 1.0f, true); });
}

static bool make_scene() {
  has_spheres = scene_name == "spheres" || scene_name == "user-spheres";
  are_users = scene_name == "user-spheres";
  if (has_spheres) balls = spheres();
  else if (scene_name == "terrain") mesh = terrain();
  else if (scene_name == "cave") mesh = cave();
  else if (scene_name == "soup") mesh = soup();
  else return false;
  auto hash = [](const auto& list) { return (unsigned long long)fnv(list.data(), list.size() * sizeof list[0]); };
  if (has_spheres) print("scene", text("\"count\": %zu, \"hashes\": [\"%016llx\"]", balls.size() / 4, hash(balls)));
  else
    print("scene", text("\"count\": %zu, \"hashes\": [\"%016llx\", \"%016llx\"]", mesh.triangles.size() / 3,
                        hash(mesh.positions), hash(mesh.triangles)));
  return true;
}

int main(int count, char** words) {
  if (count != 4) return fprintf(stderr, "usage: bench SCENE REPEATS QUALITY\n"), 2;
  scene_name = words[1], quality_name = words[3];
  int repeats = atoi(words[2]);
  if (!make_scene()) return fprintf(stderr, "error: unknown scene `%s`\n", words[1]), 2;
  RTCBuildQuality quality = quality_name == "high"  ? RTC_BUILD_QUALITY_HIGH
                            : quality_name == "low" ? RTC_BUILD_QUALITY_LOW
                                                    : RTC_BUILD_QUALITY_MEDIUM;
#if defined(__SSE__)
  // As Embree's manual advises.
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
#endif
  RTCDevice device = rtcNewDevice("threads=1");
  auto monitor = [](void*, ssize_t bytes, bool) { return held += bytes, true; };
  rtcSetDeviceMemoryMonitorFunction(device, monitor, nullptr);
  print("version", text("\"number\": %ld", (long)rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION)));
  Built built = build(device, quality);
  std::vector<double> seconds = {built.seconds};
  for (int i = 1; i < std::min(repeats, 3); i++) {
    rtcReleaseScene(built.scene);
    built = build(device, quality);
    seconds.push_back(built.seconds);
  }
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) return fprintf(stderr, "error: Embree refuses\n"), 1;
  std::sort(seconds.begin(), seconds.end());
  print("build", text("\"seconds\": %.6f, \"bytes\": %zu, \"list_bytes\": %zu", seconds[seconds.size() / 2], built.bytes,
                      built.list_bytes));
  if (repeats > 0) measure_all(built.scene, repeats);
  rtcReleaseScene(built.scene);
  rtcReleaseDevice(device);
  return 0;
}
