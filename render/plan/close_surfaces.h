#pragma once

#include <cstddef>
#include <vector>

#include "generator/registry.h"
#include "render/plan/instances.h"

namespace farol::render {

/// How much finer than `error` a mesh has to be because another exact surface is nearly the same:
/// where two nest or cross, their meshes' errors decide which one shows.
struct Closeness {
    double share = 1.0;  ///< of the error that is left; 1: nothing is near
    double gap = 0.0;    ///< an error that is small enough at any share, world units
};

/// One of each instance; empty where no two open exact surfaces have their middles and sizes within
/// a tenth and half of one's points within 3 % of the other. In such a pair, with the median gap g
/// as a share of the size, the border of a crossing moves by about twice the meshes' error over g:
/// the share is g. Nested ones need an eighth of their smallest gap. Compares 256 surfaces at
/// most: crowds are not refined.
std::vector<Closeness> closeSurfaces(const InstanceList& list);

/// Makes the mesh of an instance with that linear part finer, where it has to be. Returns whether.
bool makeFiner(generator::Fineness& fine, const Closeness& close, const glm::dmat3& linear);

}  // namespace farol::render
