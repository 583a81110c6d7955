#pragma once

#include "scene/repair/repair.h"

namespace farol::scene {

/// One pass over a document that copies it, repaired, into Repaired::text.
class RepairScanner {
  public:
    RepairScanner(std::string_view source, const LineIndex& lines, const ReadLimits& limits,
                  Findings& findings);
    Repaired run();

  private:
    struct Open {
        std::string_view name;
        std::size_t offset;
        bool keepsText;
    };

    // The parts of a document.
    void markup();
    void text(std::size_t end);
    void comment();
    void characterData();
    void declaration();
    void instruction();
    void endTag();
    void startTag();
    bool attribute(bool glued);
    std::pair<std::size_t, std::size_t> attributeValue(std::string_view key);
    std::pair<std::size_t, std::size_t> bareValue();
    void push(std::string_view name, std::size_t offset);
    void warnOfRoots();
    void pop();
    std::string closedEarlier(std::string_view name) const;

    // The source.
    bool ended() const { return at_ >= source_.size(); }
    bool starts(std::string_view word) const;
    char peek(std::size_t ahead = 0) const;
    std::string_view name();
    bool skipBlanks();
    std::size_t curlyQuote(std::size_t at) const;

    // The result.
    void literal(std::string_view made);
    void copy(std::size_t begin, std::size_t end);
    std::size_t reference(std::size_t at, std::size_t end);

    Location where(std::size_t offset) const { return lines_.at(offset); }

    std::string_view source_;
    const LineIndex& lines_;
    const ReadLimits& limits_;
    Findings& findings_;
    Repaired result_;
    std::vector<Open> open_;
    /// Where containers were closed by "/>" last, by name: for end tags too many.
    std::map<std::string, std::size_t> emptied_;
    std::size_t at_ = 0;
    std::vector<Open> roots_;
    bool latin1_ = false;
    bool truncated_ = false;  ///< the document ends inside a comment or CDATA section
};

}  // namespace farol::scene
