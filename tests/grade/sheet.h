#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "classroom.h"

/// Mistakes planted in the text of a document, several at a time: a line is an element. It shares
/// nothing with the grader's search, which changes scenes in memory.
namespace farol::test {

/// Numbers that are the same on every machine (SplitMix64).
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : state_(seed) {}
    std::size_t below(std::size_t count);

  private:
    std::uint64_t state_;
};

/// A document, one element a line, as scene/write/writer.h writes it.
class Sheet {
  public:
    explicit Sheet(const std::string& xml);
    std::string text() const;

    std::size_t size() const { return lines_.size(); }
    bool is(std::size_t line, const std::string& tag) const;
    std::optional<double> number(std::size_t line, const std::string& attribute) const;
    std::string word(std::size_t line, const std::string& attribute) const;
    void set(std::size_t line, const std::string& attribute, const std::string& value);
    void set(std::size_t line, const std::string& attribute, double value);
    /// The line that closes the element: itself for one without content.
    std::size_t endOf(std::size_t line) const;
    /// The line of the innermost group around; size() where there is none.
    std::size_t groupOf(std::size_t line) const;
    /// Lines of that tag that no plant has touched, nor any line of their elements.
    std::vector<std::size_t> free(const std::string& tag) const;
    /// Whether a plant touched any line of the element.
    bool isTouched(std::size_t line) const;
    /// The number of models in an element.
    std::size_t models(std::size_t line) const;

    void mark(std::size_t line, int plant) { lines_[line].plant = plant; }
    void markAll(std::size_t from, std::size_t to, int plant);
    std::vector<std::string> cut(std::size_t from, std::size_t to);
    void paste(std::size_t before, const std::vector<std::string>& lines, int plant);
    void swapLines(std::size_t a, std::size_t b) { std::swap(lines_[a], lines_[b]); }
    /// The numbers, from 1, of the lines that a plant marked.
    std::set<int> linesOf(int plant) const;

  private:
    struct Line {
        std::string text;
        int plant = 0;
    };
    std::vector<Line> lines_;
};

/// A mistake that was planted.
struct Planted {
    std::string kind;
    std::vector<std::string> codes;  ///< causes that name it rightly
    std::set<int> lines;             ///< of the final document; none: nothing is left of it there
    double severity = 0.0;           ///< by the table of severities
};

struct Plant {
    std::string name;
    std::vector<std::string> codes;
    double least, most;  ///< severity where hardly anything, and where all of the work is touched
    bool hasLine;        ///< false: the document lacks something
    bool isStructural;   ///< moves or removes elements: planted first
    /// Returns the share of models that it touches, or nothing where there is no place for it.
    std::optional<double> (*apply)(Sheet& sheet, Work& work, Dice& dice, int plant);
};

/// The kinds that are planted, with severities written before anything was graded.
const std::vector<Plant>& plants();

/// A document with up to `most` mistakes, each of which changes what `isSeen` compares.
struct Composed {
    std::string xml;
    Files files;
    std::vector<Planted> planted;
};
Composed compose(const ReferenceScene& reference, const std::string& xml, std::size_t count,
                 std::uint64_t seed,
                 const std::function<bool(const Work& before, const std::string& xmlBefore,
                                          const Work& after, const std::string& xmlAfter)>& isSeen);

}  // namespace farol::test
