#include "grade/rubric/frame.h"

#include "grade/images/measures.h"

namespace farol::grade {

FramePair::FramePair(const Frame& reference, const Frame& submission,
                     const std::vector<Rectangle>& hidden, bool hidesAxes)
    : reference_(reference),
      submission_(submission),
      hidden_(hidden),
      hidesAxes_(hidesAxes),
      hasSameColors_(reference.color == submission.color) {}

const Plane& FramePair::beyond() {
    if (!beyond_) beyond_ = beyondAPixel(reference_.color, submission_.color, kFullLevels);
    return *beyond_;
}

const Mask& FramePair::counted() {
    if (counted_) return *counted_;
    counted_.emplace();
    hide(*counted_, width(), height(), hidden_);
    if (hidesAxes_) hideAxes(*counted_, reference_.color, submission_.color);
    return *counted_;
}

const Mask& FramePair::content() {
    if (content_) return *content_;
    content_ = contentOf(reference_.color, submission_.color);
    if (hidesAxes_) hideAxes(*content_, reference_.color, submission_.color);
    return *content_;
}

const Mask& FramePair::sharedObjects() {
    if (!sharedObjects_) sharedObjects_ = shared(reference_.ids, submission_.ids);
    return *sharedObjects_;
}

}  // namespace farol::grade
