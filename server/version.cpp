#include "server/version.h"

namespace farol::server {

std::string projectVersion() { return FAROL_VERSION; }

}  // namespace farol::server
