#pragma once

namespace farol::cli {

/// Opens /dev/null for each closed descriptor of 0 to 2, so that no file or socket of the program
/// gets its number. Reading and writing them fails as before (EBADF): 0 is opened for writing, 1
/// and 2 for reading. Returns false on failure. Precondition: nothing has opened a descriptor
/// before.
bool holdStandardDescriptors();

}  // namespace farol::cli
