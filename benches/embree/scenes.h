// The scenes and rays of benches/kernel once more, bit for bit: nothing but additions, multiplications, divisions and
// square roots in double precision, and one rounding to single. Compile with -ffp-contract=off: no fused operations.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

struct Vector {
  double x, y, z;
};
inline Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector operator*(Vector a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector cross(Vector a, Vector b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline Vector normalized(Vector a) {
  double length = std::sqrt(dot(a, a));
  return {a.x / length, a.y / length, a.z / length};
}
inline Vector wide(const float* p) { return {p[0], p[1], p[2]}; }

// SplitMix64: the finalizer, and numbers from 0 to 1 in steps of 2^-24, which are exact in single precision too.
const uint64_t GOLDEN = 0x9E3779B97F4A7C15ull;
inline uint64_t mix(uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
  return z ^ (z >> 31);
}
inline double unit(uint64_t hash) { return (double)(hash >> 40) * (1.0 / 16777216.0); }
struct Random {
  uint64_t state;
  double next() {
    state += GOLDEN;
    return unit(mix(state));
  }
};

// FNV-1a.
inline uint64_t fnv(const void* data, size_t size) {
  uint64_t hash = 0xCBF29CE484222325ull;
  for (size_t i = 0; i < size; i++) hash = (hash ^ ((const unsigned char*)data)[i]) * 0x100000001B3ull;
  return hash;
}

struct Mesh {
  std::vector<float> positions;     // three for each vertex
  std::vector<uint32_t> triangles;  // three vertices each
  void add(Vector p) { positions.insert(positions.end(), {(float)p.x, (float)p.y, (float)p.z}); }
  // The triangles of a square grid of side x side vertices, the first of which has the number `first`.
  void add_grid(int side, uint32_t first) {
    for (int row = 0; row + 1 < side; row++)
      for (int column = 0; column + 1 < side; column++) {
        uint32_t a = first + (uint32_t)(row * side + column), b = a + (uint32_t)side;
        triangles.insert(triangles.end(), {a, b, a + 1, a + 1, b, b + 1});
      }
  }
};

// The whole number below a coordinate, and how far it is on its smooth way to the next.
struct Cell {
  int64_t at;
  double step;
  explicit Cell(double coordinate) {
    double floor = std::floor(coordinate), t = coordinate - floor;
    at = (int64_t)floor;
    step = t * t * (3.0 - 2.0 * t);
  }
};
inline double between(double a, double b, double t) { return a + (b - a) * t; }
const uint64_t OCTAVE = 0x165667B19E3779F9ull;

// Value noise: random numbers at the points with whole coordinates, and smooth steps between. In the plane ...
inline double noise2(double x, double z, uint64_t octave) {
  Cell cx(x), cz(z);
  auto at = [&](int dx, int dz) {
    return unit(mix((uint64_t)(cx.at + dx) * GOLDEN + (uint64_t)(cz.at + dz) * 0xC2B2AE3D27D4EB4Full + (octave + 1) * OCTAVE));
  };
  double near = between(at(0, 0), at(1, 0), cx.step), far = between(at(0, 1), at(1, 1), cx.step);
  return between(near, far, cz.step);
}
// ... and in space.
inline double noise3(Vector p, uint64_t octave) {
  Cell cx(p.x), cy(p.y), cz(p.z);
  auto layer = [&](int dz) {
    auto at = [&](int dx, int dy) {
      return unit(mix((uint64_t)(cx.at + dx) * GOLDEN + (uint64_t)(cy.at + dy) * 0xD6E8FEB86659FD93ull +
                      (uint64_t)(cz.at + dz) * 0xC2B2AE3D27D4EB4Full + (octave + 1) * OCTAVE));
    };
    return between(between(at(0, 0), at(1, 0), cx.step), between(at(0, 1), at(1, 1), cx.step), cy.step);
  };
  double near = layer(0), far = layer(1);
  return between(near, far, cz.step);
}
template <class Noise>
double octaves(double sum, double amplitude, double frequency, Noise noise) {
  for (uint64_t octave = 0; octave < 6; octave++) {
    sum += amplitude * noise(frequency, octave);
    amplitude *= 0.5;
    frequency *= 2.0;
  }
  return sum;
}

// Hills over the unit square: 708 x 708 vertices, 999 698 triangles.
inline Mesh terrain() {
  const int side = 708;
  Mesh mesh;
  for (int row = 0; row < side; row++)
    for (int column = 0; column < side; column++) {
      double x = (double)column / (side - 1), z = (double)row / (side - 1);
      double y = octaves(0.0, 0.08, 4.0, [&](double f, uint64_t octave) { return noise2(x * f, z * f, octave); });
      mesh.add({x, y, z});
    }
  mesh.add_grid(side, 0);
  return mesh;
}
// A bumpy ball, seen from within: the six faces of a cube of 289 x 289 squares each, 1 002 252 triangles.
inline Mesh cave() {
  const int cells = 289;
  Mesh mesh;
  for (int face = 0; face < 6; face++) {
    int axis = face / 2;
    uint32_t first = (uint32_t)(mesh.positions.size() / 3);
    for (int row = 0; row <= cells; row++)
      for (int column = 0; column <= cells; column++) {
        double point[3];
        point[axis] = face % 2 == 1 ? -1.0 : 1.0;
        point[(axis + 1) % 3] = -1.0 + 2.0 * column / cells;
        point[(axis + 2) % 3] = -1.0 + 2.0 * row / cells;
        Vector direction = normalized({point[0], point[1], point[2]});
        mesh.add(direction * octaves(0.75, 0.25, 2.0, [&](double f, uint64_t octave) { return noise3(direction * f, octave); }));
      }
    mesh.add_grid(cells + 1, first);
  }
  return mesh;
}
// A million triangles at random in the unit cube; each corner is at most 0.005 from a middle, along each axis.
inline Mesh soup() {
  Mesh mesh;
  Random random{42};
  for (uint32_t first = 0; first < 3000000; first += 3) {
    double middle[3];
    for (double& coordinate : middle) coordinate = random.next();
    for (int corner = 0; corner < 3; corner++)
      for (double coordinate : middle) mesh.positions.push_back((float)(coordinate + (2.0 * random.next() - 1.0) * 0.005));
    mesh.triangles.insert(mesh.triangles.end(), {first, first + 1, first + 2});
  }
  return mesh;
}
// A million balls at random in the unit cube: center and radius.
inline std::vector<float> spheres() {
  std::vector<float> numbers;
  Random random{43};
  for (int i = 0; i < 1000000; i++) {
    for (int axis = 0; axis < 3; axis++) numbers.push_back((float)random.next());
    numbers.push_back((float)(0.001 + 0.003 * random.next()));
  }
  return numbers;
}

struct Ray {
  float origin[3], direction[3];
};
inline Ray ray(Vector o, Vector d) { return {{(float)o.x, (float)o.y, (float)o.z}, {(float)d.x, (float)d.y, (float)d.z}}; }

struct View {
  Vector eye, target;
  double half_width;
  Vector lamp;
};
const View OVER_TERRAIN = {{0.5, 0.45, 0.0}, {0.5, 0.05, 0.5}, 0.4, {0.9, 0.3, 0.9}};
const View INTO_CUBE = {{0.5, 0.5, -0.9}, {0.5, 0.5, 0.5}, 0.5, {0.5, 1.5, -0.5}};
const View WITHIN_CAVE = {{0.0, 0.0, 0.0}, {0.3, 0.1, 1.0}, 0.8, {0.3, 0.4, 0.2}};

// The eye's rays: tiles of 8 x 8 pixels, in them blocks of 4 x 2, all row by row. Eight in a row are one block.
inline std::vector<Ray> primary(const View& view) {
  const int size = 1024;
  Vector forward = normalized(view.target - view.eye), right = normalized(cross(forward, {0, 1, 0})), up = cross(right, forward);
  std::vector<Ray> rays;
  for (int i = 0; i < size * size; i++) {
    int tile = i / 64, block = i / 8 % 8, pixel = i % 8, tiles = size / 8;
    int column = tile % tiles * 8 + block % 2 * 4 + pixel % 4, row = tile / tiles * 8 + block / 2 * 2 + pixel / 4;
    double x = (2.0 * (column + 0.5) / size - 1.0) * view.half_width, y = (1.0 - 2.0 * (row + 0.5) / size) * view.half_width;
    rays.push_back(ray(view.eye, normalized(forward + right * x + up * y)));
  }
  return rays;
}

// A point that was hit, and the unit normal towards where the ray came from.
struct Point {
  Vector at, normal;
};
inline Point towards(const Ray& ray, Point point) {
  if (dot(point.normal, wide(ray.direction)) > 0) point.normal = point.normal * -1.0;
  return point;
}
inline Point on_triangle(const Mesh& mesh, uint32_t triangle, const Ray& ray) {
  auto corner = [&](int i) { return wide(&mesh.positions[3 * mesh.triangles[3 * triangle + i]]); };
  Vector a = corner(0), b = corner(1), c = corner(2), origin = wide(ray.origin), direction = wide(ray.direction);
  Vector normal = normalized(cross(b - a, c - a));
  double t = dot(normal, a - origin) / dot(normal, direction);
  return towards(ray, {origin + direction * t, normal});
}
inline Point on_sphere(const float* sphere, const Ray& ray) {
  Vector center = wide(sphere), direction = wide(ray.direction), from_center = wide(ray.origin) - center;
  double radius = sphere[3], a = dot(direction, direction), b = dot(from_center, direction);
  double discriminant = b * b - a * (dot(from_center, from_center) - radius * radius);
  double t = (-b - std::sqrt(discriminant < 0 ? 0 : discriminant)) / a;
  Vector point = wide(ray.origin) + direction * t;
  return towards(ray, {point, normalized(point - center)});
}

// A ray into a random direction, with the density of the cosine to the normal; `index` tells rays apart.
inline Ray bounce(uint64_t index, const Point& point) {
  Random random{0xD1B54A32D192ED03ull ^ (index * GOLDEN)};
  Vector s;
  double squared;
  do {
    s.x = 2.0 * random.next() - 1.0;
    s.y = 2.0 * random.next() - 1.0;
    s.z = 2.0 * random.next() - 1.0;
    squared = dot(s, s);
  } while (squared > 1.0 || squared < 1e-9);
  Vector direction = point.normal + s * (1.0 / std::sqrt(squared));
  if (dot(direction, direction) < 1e-9) direction = point.normal;
  return ray(point.at + point.normal * 1e-5, normalized(direction));
}
// The ray to the lamp, which is at distance 1.
inline Ray shadow(const View& view, const Point& point) {
  Vector origin = point.at + point.normal * 1e-5;
  return ray(origin, view.lamp - origin);
}
