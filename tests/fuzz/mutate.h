#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace farol::fuzz {

/// Makes inputs out of inputs; the same seed makes the same inputs on every machine.
class Mutator {
  public:
    Mutator(std::uint64_t seed, const std::vector<std::string>& tokens)
        : random_(seed), tokens_(tokens) {}

    /// One to eight edits of `text`: bits, bytes, ranges, numbers, words, tokens, nesting, pieces
    /// of `other`. Never longer than `maxSize`.
    std::string mutate(std::string text, const std::string& other, std::size_t maxSize);

    /// 0..count-1; 0 for 0. Not std::uniform_int_distribution, which differs among libraries.
    std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }

  private:
    struct Range {
        std::size_t begin, size;
    };
    void edit(std::string& text, const std::string& other);
    void editBytes(std::string& text);
    void editRanges(std::string& text, const std::string& other);
    void editWords(std::string& text, const std::string& other);
    void nest(std::string& text);
    Range range(const std::string& text);
    Range line(const std::string& text);
    Range run(const std::string& text, bool (*belongs)(char));
    std::string token();

    std::mt19937_64 random_;
    const std::vector<std::string>& tokens_;
};

}  // namespace farol::fuzz
