#pragma once

#include <string>
#include <vector>

#include "grade/structure/diagnosis.h"

namespace farol::grade {

/// Traits of a submission that its reference lacks, to compare submissions with each other.
/// Each list is sorted, each text once, at most 300 of at most 200 bytes.
struct Traits {
    std::vector<std::string> causes;    ///< with the exact numbers
    std::vector<std::string> places;    ///< of objects: the mesh and the composed matrix
    std::vector<std::string> comments;  ///< of the document
    std::vector<std::string> runs;      ///< digests of four consecutive tags as they are written
};

/// `xml` is the submission's document, `referenceXml` the reference's.
Traits traitsOf(const Diagnosis& diagnosis, const Outline& reference, const std::string& xml,
                const std::string& referenceXml);

}  // namespace farol::grade
