#include "worker/attempts.h"

#include <fcntl.h>
#include <linux/bpf.h>
#include <linux/io_uring.h>
#include <linux/kcmp.h>
#include <linux/keyctl.h>
#include <linux/perf_event.h>
#include <linux/sched.h>
#include <sched.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <sys/ipc.h>
#include <sys/mman.h>
#include <sys/personality.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "worker/sandbox.h"

namespace farol::worker {
namespace {

using Outcomes = std::map<std::string, std::string>;

constexpr std::size_t kPage = 4096;

std::string mapped(int flags, int descriptor = -1) {
    void* const address = mmap(nullptr, kPage, PROT_READ, flags, descriptor, 0);
    const std::string result = outcome(address == MAP_FAILED ? -1 : 0);
    if (address != MAP_FAILED) munmap(address, kPage);
    return result;
}

/// Signals of descriptors: to another process, or a stop of this one's readers.
void tryDescriptors(Outcomes& outcomes, int folder) {
    const pid_t parent = getppid();
    f_owner_ex owner{F_OWNER_PID, parent};
    outcomes["fcntl F_SETOWN"] = outcome(fcntl(1, F_SETOWN, parent));
    outcomes["fcntl F_SETOWN_EX"] = outcome(fcntl(1, F_SETOWN_EX, &owner));
    outcomes["fcntl F_SETSIG"] = outcome(fcntl(1, F_SETSIG, SIGKILL));
    outcomes["fcntl F_SETFL"] = outcome(fcntl(1, F_SETFL, fcntl(1, F_GETFL)));
    outcomes["fcntl F_SETFL O_ASYNC"] = outcome(fcntl(1, F_SETFL, O_ASYNC));
    outcomes["fcntl F_NOTIFY"] = outcome(fcntl(folder, F_NOTIFY, DN_ACCESS));
    outcomes["fcntl F_SETLEASE"] = outcome(fcntl(folder, F_SETLEASE, F_RDLCK));
    outcomes["fcntl F_SETPIPE_SZ"] = outcome(fcntl(1, F_SETPIPE_SZ, 4096));
    int on = 1;
    pid_t group = parent;
    outcomes["ioctl FIOASYNC"] = outcome(ioctl(1, FIOASYNC, &on));
    outcomes["ioctl FIOSETOWN"] = outcome(ioctl(1, FIOSETOWN, &group));
    outcomes["ioctl FIONBIO"] = outcome(ioctl(1, FIONBIO, &on));
    outcomes["ioctl TIOCSTI"] = outcome(ioctl(0, TIOCSTI, "x"));
    char byte = 'x';
    iovec part{&byte, 1};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    outcomes["sendmsg"] = outcome(sendmsg(kSocket, &message, MSG_DONTWAIT));
    outcomes["recvmsg"] = outcome(recvmsg(kSocket, &message, MSG_DONTWAIT));
    outcomes["splice"] = outcome(syscall(SYS_splice, 0, nullptr, 1, nullptr, 1, 0));
    outcomes["eventfd"] = outcome(eventfd(0, 0));
}

/// Tries memory that the limits do not count, and madvise() with effects outside the process.
void tryMemory(Outcomes& outcomes) {
    outcomes["mmap shared anonymous"] = mapped(MAP_SHARED | MAP_ANONYMOUS);
    outcomes["mmap growing down"] = mapped(MAP_PRIVATE | MAP_ANONYMOUS | MAP_GROWSDOWN);
    outcomes["mmap huge pages"] = mapped(MAP_PRIVATE | MAP_ANONYMOUS | MAP_HUGETLB);
    outcomes["mmap locked"] = mapped(MAP_PRIVATE | MAP_ANONYMOUS | MAP_LOCKED);
    outcomes["memfd_create"] = outcome(memfd_create("farol", 0));
    outcomes["shmget"] = outcome(shmget(IPC_PRIVATE, kPage, 0600));
    void* const page =
        mmap(nullptr, kPage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    outcomes["madvise MADV_MERGEABLE"] = outcome(madvise(page, kPage, MADV_MERGEABLE));
    outcomes["madvise MADV_HWPOISON"] = outcome(madvise(page, kPage, MADV_HWPOISON));
    outcomes["madvise MADV_PAGEOUT"] = outcome(madvise(page, kPage, MADV_PAGEOUT));
    outcomes["mlock2"] = outcome(syscall(SYS_mlock2, page, kPage, 0));
    outcomes["mlockall"] =
        outcome(syscall(SYS_mlockall, MCL_CURRENT));  // not a sanitizer's stand-in
    outcomes["userfaultfd"] = outcome(syscall(SYS_userfaultfd, O_CLOEXEC));
    munmap(page, kPage);
}

/// Other processes: their memory, limits, processors and signals.
void tryProcesses(Outcomes& outcomes) {
    const pid_t parent = getppid();
    char byte = 0;
    iovec here{&byte, 1}, there{&byte, 1};
    outcomes["process_vm_readv"] = outcome(process_vm_readv(parent, &here, 1, &there, 1, 0));
    outcomes["process_vm_writev"] = outcome(process_vm_writev(parent, &here, 1, &there, 1, 0));
    outcomes["kcmp"] = outcome(syscall(SYS_kcmp, getpid(), parent, KCMP_FILES, 0, 0));
    outcomes["pidfd_open"] = outcome(syscall(SYS_pidfd_open, parent, 0));
    outcomes["kill"] = outcome(kill(parent, 0));
    outcomes["tgkill"] = outcome(syscall(SYS_tgkill, parent, parent, 0));
    outcomes["tkill"] = outcome(syscall(SYS_tkill, parent, 0));
    siginfo_t info{};
    info.si_code = SI_QUEUE;
    outcomes["rt_sigqueueinfo"] = outcome(syscall(SYS_rt_sigqueueinfo, parent, SIGURG, &info));
    unsigned long processors = 1;
    outcomes["sched_setaffinity"] =
        outcome(syscall(SYS_sched_setaffinity, 0, sizeof processors, &processors));
    outcomes["sched_setaffinity of the parent"] =
        outcome(syscall(SYS_sched_setaffinity, parent, sizeof processors, &processors));
    const sched_param plain{};
    outcomes["sched_setscheduler"] = outcome(sched_setscheduler(0, SCHED_OTHER, &plain));
    outcomes["setpriority"] = outcome(setpriority(PRIO_USER, getuid(), 19));
    rlimit limits{};
    getrlimit(RLIMIT_NOFILE, &limits);
    outcomes["setrlimit"] = outcome(setrlimit(RLIMIT_NOFILE, &limits));
    outcomes["prlimit of the parent"] = outcome(prlimit(parent, RLIMIT_NOFILE, nullptr, &limits));
    const itimerval never{};
    outcomes["setitimer"] = outcome(setitimer(ITIMER_REAL, &never, nullptr));
    timer_t timer{};
    outcomes["timer_create"] = outcome(timer_create(CLOCK_MONOTONIC, nullptr, &timer));
}

/// Parts of the kernel that were ways out of sandboxes before.
void tryKernel(Outcomes& outcomes) {
    perf_event_attr counter{};
    counter.size = sizeof counter;
    counter.type = PERF_TYPE_SOFTWARE;
    counter.config = PERF_COUNT_SW_DUMMY;
    outcomes["perf_event_open"] = outcome(syscall(SYS_perf_event_open, &counter, 0, -1, -1, 0UL));
    bpf_attr map{};
    map.map_type = BPF_MAP_TYPE_ARRAY;
    map.key_size = map.value_size = 4;
    map.max_entries = 1;
    outcomes["bpf"] = outcome(syscall(SYS_bpf, BPF_MAP_CREATE, &map, sizeof map));
    io_uring_params ring{};
    outcomes["io_uring_setup"] = outcome(syscall(SYS_io_uring_setup, 1, &ring));
    outcomes["keyctl"] =
        outcome(syscall(SYS_keyctl, KEYCTL_GET_KEYRING_ID, KEY_SPEC_PROCESS_KEYRING, 1));
    outcomes["personality"] = outcome(personality(0xFFFFFFFF));
    outcomes["prctl PR_SET_DUMPABLE"] = outcome(prctl(PR_SET_DUMPABLE, 1));
    outcomes["prctl PR_SET_PDEATHSIG"] = outcome(prctl(PR_SET_PDEATHSIG, 0));
    outcomes["prctl PR_SET_MM"] = outcome(prctl(PR_SET_MM, PR_SET_MM_BRK, 0, 0, 0));
    outcomes["chmod"] = outcome(chmod("/dev/null", 0666));
    outcomes["chdir"] = outcome(chdir("/"));
    outcomes["umask"] = outcome(syscall(SYS_umask, 022));
    outcomes["inotify_init"] = outcome(syscall(SYS_inotify_init1, 0));
    // A thread in a namespace; the flag alone is refused, so no stack is needed.
    outcomes["clone CLONE_NEWNET"] = outcome(
        syscall(SYS_clone, CLONE_VM | CLONE_SIGHAND | CLONE_THREAD | CLONE_NEWNET, 0, 0, 0, 0));
    outcomes["clone CLONE_VFORK"] = outcome(syscall(SYS_clone, CLONE_VFORK | SIGCHLD, 0, 0, 0, 0));
    outcomes["setns"] = outcome(syscall(SYS_setns, 0, 0));
}

}  // namespace

std::string outcome(long result) {
    if (result >= 0) return "done";
    const char* name = strerrorname_np(errno);
    return name == nullptr ? std::to_string(errno) : name;
}

std::map<std::string, std::string> tryForbiddenCalls() {
    Outcomes outcomes;
    const int folder = open("/usr/lib", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    tryDescriptors(outcomes, folder);
    if (folder >= 0) close(folder);
    tryMemory(outcomes);
    tryProcesses(outcomes);
    tryKernel(outcomes);
    return outcomes;
}

}  // namespace farol::worker
