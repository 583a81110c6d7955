#include <fcntl.h>
#include <sched.h>
#include <seccomp.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "server/worker/sandbox.h"

namespace farol::server::worker {
namespace {

// What Mesa, LLVM, the C library and the readers of files call once all is set up. Whatever is not
// here, or not as below, fails with EPERM.
constexpr int kAllowed[] = {
    // memory and threads; LLVM makes code at run time, so that executable pages stay possible
    SCMP_SYS(brk), SCMP_SYS(mmap), SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(mprotect),
    SCMP_SYS(madvise), SCMP_SYS(futex), SCMP_SYS(set_robust_list), SCMP_SYS(get_robust_list),
    SCMP_SYS(rseq), SCMP_SYS(membarrier), SCMP_SYS(sched_yield), SCMP_SYS(sched_getaffinity),
    SCMP_SYS(sched_setaffinity), SCMP_SYS(sched_getparam), SCMP_SYS(sched_getscheduler),
    SCMP_SYS(getcpu), SCMP_SYS(exit), SCMP_SYS(exit_group), SCMP_SYS(restart_syscall),
    // time
    SCMP_SYS(clock_gettime), SCMP_SYS(clock_getres), SCMP_SYS(clock_nanosleep), SCMP_SYS(nanosleep),
    SCMP_SYS(gettimeofday), SCMP_SYS(time),
    // facts about itself
    SCMP_SYS(getpid), SCMP_SYS(gettid), SCMP_SYS(getppid), SCMP_SYS(getuid), SCMP_SYS(geteuid),
    SCMP_SYS(getgid), SCMP_SYS(getegid), SCMP_SYS(getrusage), SCMP_SYS(times), SCMP_SYS(uname),
    SCMP_SYS(sysinfo), SCMP_SYS(getrandom), SCMP_SYS(getcwd),
    // descriptors that are open, and names; what may be opened is said below
    SCMP_SYS(read), SCMP_SYS(readv), SCMP_SYS(pread64), SCMP_SYS(preadv), SCMP_SYS(write),
    SCMP_SYS(writev), SCMP_SYS(lseek), SCMP_SYS(close), SCMP_SYS(dup), SCMP_SYS(fcntl),
    SCMP_SYS(poll), SCMP_SYS(ppoll), SCMP_SYS(fstat), SCMP_SYS(stat), SCMP_SYS(lstat),
    SCMP_SYS(newfstatat), SCMP_SYS(statx), SCMP_SYS(access), SCMP_SYS(faccessat),
    SCMP_SYS(faccessat2), SCMP_SYS(readlink), SCMP_SYS(readlinkat), SCMP_SYS(getdents64),
    SCMP_SYS(fadvise64),
    // signals to nobody else
    SCMP_SYS(rt_sigaction), SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn),
    SCMP_SYS(sigaltstack)};

class Filter {
  public:
    Filter() : context_(seccomp_init(SCMP_ACT_ERRNO(EPERM))) {}
    ~Filter() {
        if (context_ != nullptr) seccomp_release(context_);
    }
    Filter(const Filter&) = delete;
    Filter& operator=(const Filter&) = delete;

    template <typename... Conditions>
    void add(std::uint32_t action, int call, Conditions... conditions) {
        // -EDOM: this machine has no such call.
        const int result =
            seccomp_rule_add(context_, action, call, sizeof...(conditions), conditions...);
        if (result != 0 && result != -EDOM && error_ == 0) error_ = -result;
    }
    /// 0, or an errno.
    int load() {
        if (context_ == nullptr) return ENOMEM;
        if (error_ != 0) return error_;
        if (const int failed = seccomp_attr_set(context_, SCMP_FLTATR_CTL_TSYNC, 1); failed != 0)
            return -failed;
        return -seccomp_load(context_);
    }
    bool usable() const { return context_ != nullptr; }

  private:
    scmp_filter_ctx context_;
    int error_ = 0;
};

scmp_arg_cmp argument(unsigned index, scmp_compare how, scmp_datum_t a, scmp_datum_t b = 0) {
    scmp_arg_cmp compare{};
    compare.arg = index;
    compare.op = how;
    compare.datum_a = a;
    compare.datum_b = b;
    return compare;
}

}  // namespace

std::string restrictCalls(int socket) {
    Filter filter;
    if (!filter.usable()) return "missing: seccomp_init failed";
    for (const int call : kAllowed) filter.add(SCMP_ACT_ALLOW, call);
    constexpr scmp_datum_t kWriting = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | O_APPEND;
    filter.add(SCMP_ACT_ALLOW, SCMP_SYS(open), argument(1, SCMP_CMP_MASKED_EQ, kWriting, 0));
    filter.add(SCMP_ACT_ALLOW, SCMP_SYS(openat), argument(2, SCMP_CMP_MASKED_EQ, kWriting, 0));
    // Threads, not processes. The C library falls back to clone, whose flags can be looked at.
    filter.add(SCMP_ACT_ALLOW, SCMP_SYS(clone),
               argument(0, SCMP_CMP_MASKED_EQ, CLONE_THREAD, CLONE_THREAD));
    filter.add(SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3));
    const auto descriptor = static_cast<scmp_datum_t>(socket);
    filter.add(SCMP_ACT_ALLOW, SCMP_SYS(sendto), argument(0, SCMP_CMP_EQ, descriptor));
    filter.add(SCMP_ACT_ALLOW, SCMP_SYS(recvfrom), argument(0, SCMP_CMP_EQ, descriptor));
    filter.add(SCMP_ACT_ALLOW, SCMP_SYS(prctl), argument(0, SCMP_CMP_EQ, PR_SET_NAME));
    // Reading limits, not setting them: the third argument is what would be set.
    filter.add(SCMP_ACT_ALLOW, SCMP_SYS(prlimit64), argument(2, SCMP_CMP_EQ, 0));
    filter.add(SCMP_ACT_ALLOW, SCMP_SYS(getrlimit));
    // abort() signals itself.
    filter.add(SCMP_ACT_ALLOW, SCMP_SYS(tgkill),
               argument(0, SCMP_CMP_EQ, static_cast<scmp_datum_t>(getpid())));
    const int failed = filter.load();
    return failed == 0 ? "on" : std::string("missing: ") + std::strerror(failed);
}

}  // namespace farol::server::worker
