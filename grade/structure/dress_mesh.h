#pragma once

#include "grade/structure/dress_fixes.h"
#include "grade/structure/places.h"

namespace farol::grade {

/// Adds fixes of the meshes of matched items: codes model.*, texture.* of their coordinates.
class MeshDresser {
  public:
    MeshDresser(const SearchContext& context, DressFixes& out);

    /// Item `i` of the reference is item `j` of the submission.
    void compare(int i, int j);

  private:
    bool standsBy(int i, int j, const Likeness& form) const;
    void compareDivisions(int i, int j);
    const Outline::Item& theirs(int i) const { return itemAt(context_.theirs, i); }
    const Outline::Item& mine(int j) const { return itemAt(out_.mine, j); }

    const SearchContext& context_;
    DressFixes& out_;
    const Poses poses_;
};

}  // namespace farol::grade
