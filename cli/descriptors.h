#pragma once

namespace farol::cli {

/// Opens /dev/null in place of each of the descriptors 0 to 2 that is closed, so that no file or
/// socket of the program gets its number. Reading and writing them fails as before (EBADF): 0 is
/// opened for writing, 1 and 2 for reading. Returns false where that is not possible. Call it
/// before anything opens a descriptor.
bool holdStandardDescriptors();

}  // namespace farol::cli
