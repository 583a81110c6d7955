#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace farol {

/// The words of an enumeration whose values are 0 to kLast: one table beside each enumeration, from
/// which readers, writers and messages follow. The words are ASCII in lower case.
template <typename Enum, Enum kLast>
class EnumWords {
  public:
    static constexpr std::size_t kSize = static_cast<std::size_t>(kLast) + 1;

    /// The words in the order of the values.
    template <typename... Words>
    consteval explicit EnumWords(Words... words) : words_{std::string_view(words)...} {
        static_assert(sizeof...(Words) == kSize, "each value has one word");
    }

    /// Precondition: a value of the enumeration.
    constexpr std::string_view operator[](Enum value) const {
        return words_[static_cast<std::size_t>(value)];
    }
    /// Returns the value of a word as written in the table, or nothing.
    constexpr std::optional<Enum> find(std::string_view word) const {
        for (std::size_t i = 0; i < kSize; ++i)
            if (words_[i] == word) return static_cast<Enum>(i);
        return std::nullopt;
    }
    constexpr const std::array<std::string_view, kSize>& all() const { return words_; }

  private:
    std::array<std::string_view, kSize> words_;
};

}  // namespace farol
