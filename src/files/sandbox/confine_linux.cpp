#include "files/sandbox/confine.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <vector>

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace cotan {

namespace {

// Handles every right to change the file system with Landlock and grants none. Kernels before 5.13 refuse.
void forbidChanges()
{
    const long version = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
    if (version < 1)
        return;
    landlock_ruleset_attr rights{};
    rights.handled_access_fs = LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR
        | LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR | LANDLOCK_ACCESS_FS_MAKE_DIR
        | LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO
        | LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;
    if (version >= 3)
        rights.handled_access_fs |= 1u << 14; // LANDLOCK_ACCESS_FS_TRUNCATE, which the headers of Debian 12 lack
    const long rules = ::syscall(SYS_landlock_create_ruleset, &rights, sizeof rights, 0);
    if (rules < 0)
        return;
    ::syscall(SYS_landlock_restrict_self, rules, 0);
    ::close(int(rules));
}

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
constexpr std::uint32_t kForeign = 0x40000000; // calls of the x32 ABI
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
constexpr std::uint32_t kForeign = 0x7fffffff;
#else
constexpr std::uint32_t kArchitecture = 0; // no filter
constexpr std::uint32_t kForeign = 0;
#endif

constexpr std::uint32_t kAllow = SECCOMP_RET_ALLOW, kRefuse = SECCOMP_RET_ERRNO | EPERM;

struct SystemCallFilter {
    std::vector<sock_filter> code;

    void add(std::uint16_t what, std::uint32_t k, std::uint8_t whenTrue = 0, std::uint8_t whenFalse = 0)
    {
        code.push_back({what, whenTrue, whenFalse, k});
    }
    void load(std::size_t offset) { add(BPF_LD | BPF_W | BPF_ABS, std::uint32_t(offset)); }
    void give(std::uint32_t verdict) { add(BPF_RET | BPF_K, verdict); }
    // Adds the verdict for one call.
    void call(long number, std::uint32_t verdict)
    {
        add(BPF_JMP | BPF_JEQ | BPF_K, std::uint32_t(number), 0, 1);
        give(verdict);
    }
    void refuse(auto... numbers) { (call(numbers, kRefuse), ...); }
    // Allows a call if `test` holds for the low half of argument i; otherwise refuses it.
    void callWith(long number, int argument, std::uint16_t test, std::uint32_t value)
    {
        add(BPF_JMP | BPF_JEQ | BPF_K, std::uint32_t(number), 0, 4);
        load(offsetof(seccomp_data, args) + 8 * std::size_t(argument));
        add(std::uint16_t(BPF_JMP | test | BPF_K), value, 0, 1);
        give(kAllow);
        give(kRefuse);
    }
};

// Refuses calls that no reader needs. Landlock protects files, except owners, modes and times.
void refuseCalls(SystemCallFilter& filter)
{
    filter.refuse(SYS_execve, SYS_execveat, SYS_ptrace, SYS_process_vm_readv, SYS_process_vm_writev);
    filter.refuse(SYS_kill, SYS_tkill, SYS_rt_sigqueueinfo, SYS_rt_tgsigqueueinfo);
    filter.refuse(SYS_pidfd_open, SYS_pidfd_getfd, SYS_pidfd_send_signal);
    filter.refuse(SYS_socket, SYS_socketpair, SYS_connect, SYS_bind, SYS_listen, SYS_accept, SYS_accept4);
    filter.refuse(SYS_io_uring_setup, SYS_bpf, SYS_perf_event_open, SYS_userfaultfd);
    filter.refuse(SYS_keyctl, SYS_add_key, SYS_request_key);
    filter.refuse(SYS_mount, SYS_umount2, SYS_chroot, SYS_pivot_root, SYS_unshare, SYS_setns);
    filter.refuse(SYS_fchmod, SYS_fchmodat, SYS_fchown, SYS_fchownat, SYS_utimensat);
    filter.refuse(SYS_setxattr, SYS_lsetxattr, SYS_fsetxattr, SYS_removexattr, SYS_lremovexattr, SYS_fremovexattr);
    filter.refuse(SYS_shmget, SYS_shmat, SYS_msgget, SYS_mq_open, SYS_setsid, SYS_setpgid);
    filter.refuse(SYS_ioctl); // it could inject input into a terminal
#ifdef SYS_fork
    // Old calls that newer architectures lack.
    filter.refuse(SYS_fork, SYS_vfork, SYS_chmod, SYS_chown, SYS_lchown, SYS_utime, SYS_utimes, SYS_futimesat);
#endif
}

void forbidCalls()
{
    if (kArchitecture == 0)
        return;
    SystemCallFilter filter;
    filter.load(offsetof(seccomp_data, arch));
    filter.add(BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 1, 0);
    filter.give(SECCOMP_RET_KILL_PROCESS);
    filter.load(offsetof(seccomp_data, nr));
    filter.add(BPF_JMP | BPF_JGE | BPF_K, kForeign, 0, 1);
    filter.give(kRefuse);
    refuseCalls(filter);
    filter.call(SYS_clone3, SECCOMP_RET_ERRNO | ENOSYS);                // its flags are behind a pointer
    filter.callWith(SYS_clone, 0, BPF_JSET, 0x00010000);                // CLONE_THREAD
    filter.callWith(SYS_tgkill, 0, BPF_JEQ, std::uint32_t(::getpid())); // abort()
    filter.callWith(SYS_prlimit64, 0, BPF_JEQ, 0);                      // this process
    filter.give(kAllow);
    const sock_fprog program{static_cast<unsigned short>(filter.code.size()), filter.code.data()};
    ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
}

} // namespace

void setLimit(int resource, std::uint64_t soft, std::uint64_t hard)
{
    rlimit limit{};
    ::getrlimit(__rlimit_resource_t(resource), &limit);
    limit.rlim_max = std::min<rlim_t>(limit.rlim_max, hard);
    limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, soft);
    ::setrlimit(__rlimit_resource_t(resource), &limit);
}

void dieWith(std::int64_t parent, int signal)
{
    ::prctl(PR_SET_PDEATHSIG, signal);
    if (::getppid() != parent) // the parent had ended before
        ::_exit(1);
}

void leaveNoCore()
{
    setLimit(RLIMIT_CORE, 0, 0);
    ::prctl(PR_SET_DUMPABLE, 0); // cores that are piped to a program have no limit
}

void confine()
{
    leaveNoCore();
    setLimit(RLIMIT_FSIZE, 0, 0);
    setLimit(RLIMIT_STACK, 8 << 20, 8 << 20); // ends infinite recursion early
    if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
        return;
    forbidChanges();
    if (!kSanitized) // these inspect the process from another one when it ends
        forbidCalls();
}

void limitTo(const ReaderBudget& budget, const ReaderBudget& maximum)
{
    const auto seconds = [](const ReaderBudget& b) { return rlim_t(std::ceil(b.seconds * (kSanitized ? 20 : 1))); };
    if (!kSanitized)
        setLimit(RLIMIT_DATA, rlim_t(budget.megabytes) << 20, rlim_t(maximum.megabytes) << 20);
    setLimit(RLIMIT_CPU, seconds(budget), seconds(maximum) + 5); // the soft limit's signal identifies the cause
}

} // namespace cotan
