#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>

#include "core/lru_cache.h"

namespace farol::render {

/// A mesh beside an exact surface, in the surface's units. Parts of a model that moves as a whole
/// stay one such pair: numbers are rounded, which takes the traces of turning from them.
struct ClosePair {
    std::uintptr_t kind = 0;         ///< of the surface: the address of its SurfaceKind
    std::array<double, 2> form{};    ///< of the surface
    std::uint64_t mesh = 0;          ///< MeshData::id
    double margin = 0.0;             ///< most distance, units, at which they are close
    std::array<double, 9> linear{};  ///< units from the mesh's object space, column by column
    std::array<double, 3> offset{};  ///< likewise
    std::array<double, 9> metric{};  ///< of covectors in world space, largest length about 1
    auto operator<=>(const ClosePair&) const = default;
};

/// Pairs that were examined, and whether they need exact depth.
class ClosePairs {
  public:
    /// Nothing if the pair is new.
    std::optional<bool> find(const ClosePair& pair) {
        const bool* known = answers_.find(pair);
        return known == nullptr ? std::nullopt : std::optional<bool>(*known);
    }
    /// Precondition: find() returned nothing.
    void put(const ClosePair& pair, bool answer) { answers_.put(pair, answer, 1); }

  private:
    static constexpr std::size_t kMaxPairs = 16384;  ///< about 5 MiB
    LruCache<ClosePair, bool> answers_{kMaxPairs};
};

}  // namespace farol::render
