#pragma once

#include <string>
#include <vector>

#include "tests/numerics/sweep.h"

namespace farol::numerics {

/// Ways to write one scene. Its bytes are the same in each where doubles hold the numbers.
struct Wording {
    glm::dvec3 move{0.0};     ///< of everything, units of RandomScene::grid
    int power = 0;            ///< the world is 2^power times as large
    int turns = 0;            ///< whole turns added to each angle
    double axisLength = 1.0;  ///< a power of two
    bool isSplit = false;     ///< moves in two halves, one transform a group, one model a group
};

/// 1 to 30 solids, planes and nested shells (a copy 1.01 to 1.0001 times as large) with rotations
/// about any axis and scales of which some are non-uniform or negative, lit by 1 to 3 lights. No
/// two faces lie in one plane.
class RandomScene {
  public:
    /// `size`: about half the extent of the scene, world units.
    RandomScene(Sweep& sweep, double size, int objects);
    std::string xml(const Wording& wording = {}) const;
    /// Places of models, lights and camera are multiples of it, up to 2^23 of them.
    double grid() const { return grid_; }

  private:
    struct Step {
        bool isRotation = false;
        double angleDeg = 0.0;  ///< a multiple of 1/1024
        glm::dvec3 value{1.0};  ///< axis or scale
    };
    struct Part {
        std::vector<Step> steps;
        std::string shape;
        std::vector<double> lengths;
        std::string material;
    };
    struct Object {
        glm::dvec3 place{0.0};
        std::vector<Part> parts;
    };
    struct Light {
        bool isDirectional = false;
        glm::dvec3 value{0.0};  ///< place, or direction towards it
    };
    glm::dvec3 snapped(const glm::dvec3& place) const;
    Part solid(double radius, bool isNested);
    void addScale(std::vector<Step>& steps);
    Step rotation();
    Object object(int& left);

    Sweep& sweep_;
    double size_, grid_;
    double unit_;  ///< of the shapes' lengths: a scale, where they would be out of their range
    Camera camera_;
    std::vector<Light> lights_;
    std::vector<Object> objects_;
};

}  // namespace farol::numerics
