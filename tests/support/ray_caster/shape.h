#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scene/scene.h"

/// The independent double-precision ray caster that pictures are measured against. It shares no
/// code with render/ or generator/: what both agree on is the specification.
namespace farol::reference {

/// A line in object space. Its parameter is the eye's depth when the ray comes from a camera, so
/// the direction is not normalised.
struct Ray {
    glm::dvec3 origin, direction;
    glm::dvec3 at(double t) const { return origin + t * direction; }
};

/// Where a ray meets a shape. A change of `face` between neighbours is a crease; `piece` and
/// `place` are the shape's own notes.
struct Hit {
    double t = std::numeric_limits<double>::infinity();
    int face = 0;
    int piece = 0;
    glm::dvec2 place{0.0};
};

/// Keeps the nearest front-facing hit with t in [from, to].
class Nearest {
  public:
    Nearest(double from, double to, bool backs) : from_(from), to_(to), backs_(backs) {}
    /// `outward`: a vector on the outer side of the surface, of any length.
    void offer(const Ray& ray, double t, const glm::dvec3& outward, int face = 0, int piece = 0,
               const glm::dvec2& place = glm::dvec2(0.0)) {
        if (!(t >= from_ && t <= to_ && t < best_.t)) return;
        if (!backs_ && !(glm::dot(outward, ray.direction) < 0.0)) return;
        best_ = {t, face, piece, place};
        found_ = true;
    }
    bool found() const { return found_; }
    const Hit& best() const { return best_; }

  private:
    double from_, to_;
    bool backs_;
    bool found_ = false;
    Hit best_;
};

/// The surface at a hit, in object space. The gradients are those of u and v as functions of the
/// position; only their part along the surface means anything.
struct Surface {
    glm::dvec3 point{0.0};
    glm::dvec3 normal{0.0, 1.0, 0.0};  ///< outward, unit, of the surface itself
    glm::dvec3 shadingNormal{0.0};     ///< unit; zero: the same
    glm::dvec2 uv{0.0};
    glm::dvec3 gradU{0.0}, gradV{0.0};
};

struct Bounds {
    glm::dvec3 min{0.0}, max{0.0};
};

/// An exact surface in object space; outward is the side that is drawn.
class Shape {
  public:
    virtual ~Shape() = default;
    virtual Bounds bounds() const = 0;
    virtual void intersect(const Ray& ray, Nearest& nearest) const = 0;
    virtual Surface surface(const Ray& ray, const Hit& hit) const = 0;
};

/// Flat and curved shapes with the conventions of docs/scene-language.md. Lengths over 0, in the
/// units of the object. Only the texture layouts `face` and `atlas` are known.
std::unique_ptr<Shape> makePlane(double size);
std::unique_ptr<Shape> makeBox(const glm::dvec3& size, scene::UvLayout uv);
std::unique_ptr<Shape> makeRing(double inner, double outer);
std::unique_ptr<Shape> makeEllipsoid(const glm::dvec3& radii);
std::unique_ptr<Shape> makeDome(double radius);
/// Radii 0 or more, at least one over 0; closed by discs where a radius is not 0.
enum class DiscLayout { face, cylinderAtlas, coneAtlas };
std::unique_ptr<Shape> makeFrustum(double bottom, double top, double height, DiscLayout layout);
std::unique_ptr<Shape> makeTorus(double ring, double tube);
/// Nets of 16 points, [4 * row + column].
using PatchNet = std::vector<glm::dvec3>;
std::unique_ptr<Shape> makePatches(const std::vector<PatchNet>& nets);
/// The profile (radius, height), turned about Y from +X towards -Z.
std::unique_ptr<Shape> makeRevolution(const std::vector<glm::dvec2>& profile);

/// Control nets of a `.patch` file, and the (x, y) of the vertices of an ascii PLY file. Both
/// throw std::invalid_argument.
std::vector<PatchNet> readPatches(const std::string& text);
std::vector<glm::dvec2> readProfile(const std::string& text);

/// The words that make a model's shape: its resolved source, its command, or its file's name
/// ("sphere_1_8_8.3d"). Throws std::invalid_argument where it is no shape's.
std::vector<std::string> wordsOf(const scene::Model& model);

/// The shape that `words` name; counts are read over, as the surface is exact. `texts` holds the
/// patch and profile files by name. Throws std::invalid_argument.
std::unique_ptr<Shape> makeShape(const std::vector<std::string>& words, scene::UvLayout uv,
                                 const std::map<std::string, std::string>& texts);

}  // namespace farol::reference
