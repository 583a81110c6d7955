#include "tests/support/paths.h"

namespace farol::test {

const char* const kSourceDir = FAROL_SOURCE_DIR;
const char* const kTestOutput = FAROL_TEST_OUTPUT;
const char* const kProgram = FAROL_PROGRAM;

}  // namespace farol::test
