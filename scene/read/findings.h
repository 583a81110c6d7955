#pragma once

#include <map>
#include <string>

#include "core/error.h"

namespace farol::scene {

/// Collects the findings of a document and its includes: bounded, in document order, warnings as
/// errors when strict. Repeated repairs of the same kind are reported a few times only.
class Findings {
  public:
    Findings(bool strict, int limit) : strict_(strict), limit_(limit) {}

    void info(Message message, Location where);
    void warn(Message message, Location where);
    void error(Message message, Location where);
    void add(Diagnostics found);
    /// Drops all findings so far and reports one error in their place.
    void replaceBy(Message message, Location where);

    /// If elements are not closed, or closed twice, drops the findings about misplaced elements,
    /// which are consequences.
    void dropFollowUps();

    bool failed() const { return failed_; }
    /// True where an element was not closed, or closed by the wrong tag.
    bool torn() const { return torn_; }
    /// True while nothing but information was found.
    bool clean() const { return !failed_ && !warned_; }
    /// True once there are more findings than will be shown: costly hints are not worth making.
    bool crowded() const { return all_.size() >= static_cast<std::size_t>(limit_); }

    /// Returns the findings by file (in order of appearance), line and column. Over the limit it
    /// keeps errors before warnings; a closing note counts the dropped ones.
    Diagnostics take() const;

  private:
    void keep(Diagnostic finding);
    void warn(Diagnostic finding);

    bool strict_;
    int limit_;
    bool failed_ = false, warned_ = false, torn_ = false;
    int dropped_ = 0;
    Diagnostics all_;
    std::map<std::string, int> repeats_;
};

}  // namespace farol::scene
