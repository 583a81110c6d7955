#pragma once

#include <memory>
#include <set>
#include <string>

#include "scene/files/assets.h"
#include "scene/scene.h"

namespace farol::grade {

/// A submission's files, with the reference's as a fallback: students leave out images and models
/// that were handed out with the task. A file of the submission hides the reference's of the same
/// base name, in any folder. Documents and .3d meshes are the student's own work and have no
/// fallback.
class LentAssets final : public scene::Assets {
  public:
    LentAssets(std::shared_ptr<const scene::Assets> own,
               std::shared_ptr<const scene::Assets> handedOut);

    std::vector<std::string> list() const override;
    bool has(const std::string& path) const override;
    std::optional<std::string> read(const std::string& path) const override;
    std::optional<std::uint64_t> size(const std::string& path) const override;
    void prefetch(const std::vector<std::string>& paths) const override;
    std::string version(const std::string& path) const override;

    /// Returns an info `grade.lent` for each file of the reference that the scene uses, by path.
    /// Precondition: the scene was resolved against these files.
    Diagnostics notes(const scene::Scene& scene) const;

  private:
    const scene::Assets& holderOf(const std::string& path) const;

    std::shared_ptr<const scene::Assets> own_, handedOut_;
    std::set<std::string> lent_;  ///< paths of handedOut_
};

}  // namespace farol::grade
