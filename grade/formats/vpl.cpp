#include "grade/formats/formats.h"
#include "grade/report/text.h"

namespace farol::grade {

void writeVpl(std::ostream& out, const Outcome& outcome, const FormatContext&) {
    // A comment that begins with "-" would be a title, with ">" preformatted: none does.
    for (const std::string& line : linesOf(outcome)) {
        const bool isMarked = line.starts_with("-") || line.starts_with(">");
        out << "Comment :=>> " << (isMarked ? "\"" + line + "\"" : line) << "\n";
    }
    // The last such line counts, and nothing follows it. Not graded: no proposal.
    if (outcome.isGraded) out << "Grade :=>> " << twoDigits(outcome.points) << "\n";
}

}  // namespace farol::grade
