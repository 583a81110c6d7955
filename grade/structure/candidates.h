#pragma once

#include <map>
#include <optional>
#include <vector>

#include "grade/structure/matching.h"
#include "grade/structure/slips.h"

namespace farol::grade {

/// One edit of the submission's tree of transforms.
struct Edit {
    enum class Kind { set, remove, insert, order, hang, hangItem, place };
    Kind kind = Kind::set;
    int node = 0;
    int item = -1;            ///< hangItem
    int link = 0;             ///< set, remove: its id. insert: the id it stands before, 0: the end
    int parent = 0;           ///< hang, hangItem
    std::vector<int> order;   ///< ids, of order
    std::vector<Link> links;  ///< place: all of the node's; insert: the new one
    Slip slip;                ///< set: the right value; of all: words
};

/// Edits that are right only together, and how unlikely they are.
struct Candidate {
    std::vector<Edit> edits;
    double effort = 0.0;
};

void applyTo(Outline& outline, const Edit& edit);

/// A pair of items, with where the submission's has to stand.
struct Pair {
    int theirs = 0, mine = 0;
    Symmetry symmetry = Symmetry::none;
    glm::dmat4 mineFromTheirs{1.0};
    std::vector<glm::dmat4> targets;  ///< of the reference's item, by time
    bool isRight = false;
};

/// Finds the changes that bring one item to its place.
class CandidateFinder {
  public:
    CandidateFinder(const Outline& theirs, const Outline& mine, const std::vector<Poses>& poses,
                    const std::vector<double>& timesS, double sceneSize)
        : theirs_(theirs), mine_(mine), poses_(poses), timesS_(timesS), size_(sceneSize) {}

    /// Single edits, and the edits that make the written chains equal.
    std::vector<Candidate> find(const Pair& pair) const;
    /// Two edits: a common slip, and the edit that is needed beside it.
    std::vector<Candidate> findTwo(const Pair& pair) const;
    /// The reference's own chain in place of all that leads to the item.
    Candidate replace(const Pair& pair) const;

  private:
    struct Step {
        int node;
        const Link* link;
    };
    /// A chain's matrices by time.
    using Matrices = std::vector<glm::dmat4>;

    std::vector<Step> stepsOf(int node) const;
    Matrices productOf(const std::vector<Step>& steps, std::size_t from, std::size_t to) const;
    bool reaches(const Pair& pair, const Matrices& world) const;
    bool reachesBy(const Pair& pair, const std::vector<Edit>& edits) const;
    std::vector<glm::dmat4> goalOf(const Pair& pair, const Matrices& world) const;

    void addNumbers(const Pair& pair, std::vector<Candidate>& out) const;
    void addInsertions(const Pair& pair, std::vector<Candidate>& out) const;
    void addOrders(const Pair& pair, std::vector<Candidate>& out) const;
    void addParents(const Pair& pair, std::vector<Candidate>& out) const;
    void addPlaces(const Pair& pair, std::vector<Candidate>& out) const;
    void addAlignment(const Pair& pair, std::vector<Candidate>& out) const;
    bool isWritten(const Pair& pair, const scene::Transform& transform) const;
    Edit insertion(const std::vector<Step>& steps, std::size_t at, int node,
                   const scene::Transform& transform) const;

    const Outline &theirs_, &mine_;
    const std::vector<Poses>& poses_;
    const std::vector<double>& timesS_;
    double size_;
};

}  // namespace farol::grade
