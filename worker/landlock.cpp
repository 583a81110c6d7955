#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>

#include "worker/sandbox.h"

// landlock(7). Newer kernels know more rights than Debian's headers name.
namespace farol::worker {
namespace {

/// struct landlock_ruleset_attr of ABI 6; older kernels take its beginning.
struct Ruleset {
    std::uint64_t files = 0, network = 0, scoped = 0;
};

constexpr std::uint64_t kRead = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
constexpr std::uint64_t kWrite = LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_FILE |
                                 LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_MAKE_DIR;
constexpr std::uint64_t kFile = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_WRITE_FILE;
constexpr std::uint64_t kRefer = 1U << 13U;          // since ABI 2
constexpr std::uint64_t kTruncate = 1U << 14U;       // since ABI 3
constexpr std::uint64_t kDeviceControl = 1U << 15U;  // since ABI 5
constexpr std::uint64_t kTcp = 3;                    // bind and connect, since ABI 4
constexpr std::uint64_t kScopes = 3;                 // abstract sockets and signals, since ABI 6

class Descriptor {
  public:
    explicit Descriptor(long fd) : fd_(static_cast<int>(fd)) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (fd_ >= 0) close(fd_);
    }
    int fd() const { return fd_; }

  private:
    int fd_;
};

std::string missing() { return std::string("missing: ") + std::strerror(errno); }

bool allow(int rules, const std::string& path, std::uint64_t rights) {
    if (path.empty()) return true;
    const Descriptor place(open(path.c_str(), O_PATH | O_CLOEXEC));
    if (place.fd() < 0) return true;  // a missing path needs no permission
    struct stat facts {};
    if (fstat(place.fd(), &facts) != 0) return false;
    landlock_path_beneath_attr beneath{};
    // Rights of folders are refused for a file.
    beneath.allowed_access = S_ISDIR(facts.st_mode) ? rights : rights & kFile;
    beneath.parent_fd = place.fd();
    return syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &beneath, 0) == 0;
}

}  // namespace

std::string restrictFiles(const std::vector<std::string>& readable,
                          const std::vector<std::string>& writable) {
    const long abi =
        syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
    if (abi < 1) return missing();
    // All rights of ABI 1 are the bits up to LANDLOCK_ACCESS_FS_MAKE_SYM.
    Ruleset all;
    all.files = (std::uint64_t{LANDLOCK_ACCESS_FS_MAKE_SYM} << 1U) - 1;
    std::uint64_t write = kWrite;
    if (abi >= 2) all.files |= kRefer;
    if (abi >= 3) {
        all.files |= kTruncate;
        write |= kTruncate;
    }
    if (abi >= 4) all.network = kTcp;
    if (abi >= 5) all.files |= kDeviceControl;
    if (abi >= 6) all.scoped = kScopes;
    const std::size_t size = abi >= 6 ? 24 : abi >= 4 ? 16 : 8;
    const Descriptor rules(syscall(SYS_landlock_create_ruleset, &all, size, 0));
    if (rules.fd() < 0) return missing();
    for (const std::string& path : readable)
        if (!allow(rules.fd(), path, kRead)) return missing();
    for (const std::string& path : writable)
        if (!allow(rules.fd(), path, kRead | write)) return missing();
    if (syscall(SYS_landlock_restrict_self, rules.fd(), 0) != 0) return missing();
    return "abi " + std::to_string(abi);
}

}  // namespace farol::worker
