// A reader process for tests. It reads as usual, or misbehaves as the variable SANDBOX_CHILD_DOES requests.
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <new>
#include <random>
#include <string>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "cotan/files.hpp"
#include "cotan/model.hpp"
#include "cotan/scene.hpp"
#include "files/sandbox/confine.hpp"
#include "files/sandbox/request.hpp"
#include "files/sandbox/scene_wire.hpp"

namespace {

using namespace cotan;

bool sendAll(std::span<const std::byte> bytes)
{
    while (!bytes.empty()) {
        const ssize_t sent = ::send(0, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent <= 0)
            return false;
        bytes = bytes.subspan(std::size_t(sent));
    }
    return true;
}

ReaderRequest takeRequest()
{
    WireIn in(
        [](std::span<std::byte> bytes) {
            return std::size_t(std::max<ssize_t>(::recv(0, bytes.data(), bytes.size(), 0), 0));
        },
        std::uint64_t(1) << 32);
    ReaderRequest request;
    exchangeRequest(in, request);
    return request;
}

std::vector<std::byte> sceneBytes(const Scene& scene)
{
    std::vector<std::byte> bytes;
    WireOut out([&](std::span<const std::byte> part) {
        bytes.insert(bytes.end(), part.begin(), part.end());
        return true;
    });
    out.choice(ReaderFrame::value, ReaderFrame::error);
    exchangeScene(out, scene);
    out.flush();
    return bytes;
}

Scene plane()
{
    Scene scene;
    scene.materials.emplace_back();
    scene.meshes.push_back(makePlane(1, 4, 1));
    scene.instances.emplace_back();
    return scene;
}

void answerError(const std::string& message)
{
    WireOut out(sendAll);
    out.choice(ReaderFrame::error, ReaderFrame::error);
    const Error error{ErrorKind::input, message};
    exchangeError(out, error);
    out.flush();
}

// An image with a header that may be false, from SANDBOX_CHILD_PICTURE: width, height, channels, number of bytes.
struct Claim {
    std::string name = "picture", frame, blocks;
    int width = 0, height = 0, channels = 0;
    PixelType type = PixelType::unorm8;
    bool alpha = false, whole = false;
    std::vector<std::byte> data, jpeg;
};

Claim claimed()
{
    Claim claim;
    const char* const words = std::getenv("SANDBOX_CHILD_PICTURE");
    std::size_t bytes = 0;
    if (words && std::sscanf(words, "%d %d %d %zu", &claim.width, &claim.height, &claim.channels, &bytes) == 4)
        claim.data.resize(bytes, std::byte(7));
    return claim;
}

void expectFor(std::function<bool()> more)
{
    WireOut out(sendAll);
    do {
        out.choice(ReaderFrame::expect, ReaderFrame::error);
        out.number(std::numeric_limits<std::uint64_t>::max());
    } while (out.flush() && more());
}

// Forbidden actions that succeed: what a compromised reader could do in the folder of the requested file and elsewhere.
std::string powers(const ReaderRequest& request)
{
    const auto folder = std::filesystem::path(request.name).parent_path();
    std::string found;
    const auto note = [&](bool possible, const char* what) { found += possible ? fmt::format(" {}", what) : ""; };
    note(::open((folder / "new").c_str(), O_WRONLY | O_CREAT, 0600) >= 0, "create");
    note(::open(request.name.c_str(), O_WRONLY) >= 0, "write");
    note(::unlink(request.name.c_str()) == 0, "remove");
    note(::rename(request.name.c_str(), (folder / "moved").c_str()) == 0, "rename");
    note(::mkdir((folder / "d").c_str(), 0700) == 0, "mkdir");
    note(::chmod(request.name.c_str(), 0777) == 0, "chmod");
    note(::truncate(request.name.c_str(), 0) == 0, "truncate");
    note(::socket(AF_INET, SOCK_STREAM, 0) >= 0, "socket");
    const pid_t child = ::fork();
    if (child == 0)
        ::_exit(0);
    note(child > 0, "fork");
    note(::kill(::getppid(), 0) == 0, "kill");
    char* const words[] = {nullptr};
    ::execve("/bin/true", words, words);                            // replaces this process if it succeeds
    note(::open(request.name.c_str(), O_RDONLY) < 0, "no-reading"); // reading must stay possible
    return found;
}

// System calls that are not refused. A refused one fails with EPERM for any arguments; others report bad arguments.
std::string notRefused()
{
    const std::pair<long, const char*> calls[] = {
        {SYS_execve, "execve"},
        {SYS_execveat, "execveat"},
        {SYS_ptrace, "ptrace"},
        {SYS_process_vm_readv, "process_vm_readv"},
        {SYS_process_vm_writev, "process_vm_writev"},
        {SYS_kill, "kill"},
        {SYS_tkill, "tkill"},
        {SYS_rt_sigqueueinfo, "rt_sigqueueinfo"},
        {SYS_rt_tgsigqueueinfo, "rt_tgsigqueueinfo"},
        {SYS_tgkill, "tgkill"},
        {SYS_prlimit64, "prlimit64"},
        {SYS_pidfd_open, "pidfd_open"},
        {SYS_pidfd_getfd, "pidfd_getfd"},
        {SYS_pidfd_send_signal, "pidfd_send_signal"},
        {SYS_socket, "socket"},
        {SYS_socketpair, "socketpair"},
        {SYS_connect, "connect"},
        {SYS_bind, "bind"},
        {SYS_listen, "listen"},
        {SYS_accept, "accept"},
        {SYS_accept4, "accept4"},
        {SYS_io_uring_setup, "io_uring_setup"},
        {SYS_bpf, "bpf"},
        {SYS_perf_event_open, "perf_event_open"},
        {SYS_userfaultfd, "userfaultfd"},
        {SYS_keyctl, "keyctl"},
        {SYS_add_key, "add_key"},
        {SYS_request_key, "request_key"},
        {SYS_mount, "mount"},
        {SYS_umount2, "umount2"},
        {SYS_chroot, "chroot"},
        {SYS_pivot_root, "pivot_root"},
        {SYS_unshare, "unshare"},
        {SYS_setns, "setns"},
        {SYS_fchmod, "fchmod"},
        {SYS_fchmodat, "fchmodat"},
        {SYS_fchown, "fchown"},
        {SYS_fchownat, "fchownat"},
        {SYS_utimensat, "utimensat"},
        {SYS_setxattr, "setxattr"},
        {SYS_lsetxattr, "lsetxattr"},
        {SYS_fsetxattr, "fsetxattr"},
        {SYS_removexattr, "removexattr"},
        {SYS_lremovexattr, "lremovexattr"},
        {SYS_fremovexattr, "fremovexattr"},
        {SYS_shmget, "shmget"},
        {SYS_shmat, "shmat"},
        {SYS_msgget, "msgget"},
        {SYS_mq_open, "mq_open"},
        {SYS_setpgid, "setpgid"},
        {SYS_ioctl, "ioctl"},
    };
    std::string found;
    for (const auto& [number, name] : calls)
        if (::syscall(number, -1, -1, -1, -1, -1, -1) != -1 || errno != EPERM)
            found += fmt::format(" {}", name);
    return found;
}

std::string openDescriptors()
{
    std::string found;
    for (int i = 0; i < 256; ++i)
        found += ::fcntl(i, F_GETFD) >= 0 ? fmt::format(" {}", i) : "";
    return found;
}

const std::map<std::string, void (*)(const ReaderRequest&)> kActs = {
    {"crash", [](const ReaderRequest&) { ::raise(SIGSEGV); }},
    {"abort",
     [](const ReaderRequest&) {
         std::fputs("expected \x1b[31mcourage\nand more\n", stderr);
         std::abort();
     }},
    {"leave", [](const ReaderRequest&) { std::exit(0); }},
    {"say",
     [](const ReaderRequest&) {
         std::fputs(std::getenv("SANDBOX_CHILD_SAYS"), stderr);
         std::exit(0);
     }},
    {"plane",
     [](const ReaderRequest&) {
         Scene scene = plane();
         const char* const instances = std::getenv("SANDBOX_CHILD_INSTANCES");
         scene.instances.resize(instances ? std::size_t(std::atoi(instances)) : 1, scene.instances.at(0));
         sendAll(sceneBytes(scene));
     }},
    {"spin",
     [](const ReaderRequest& request) {
         limitTo(budgetFor(request.limits, 0, 0), budgetFor(request.limits, SIZE_MAX, SIZE_MAX));
         for (volatile bool busy = true; busy;)
             ;
     }},
    {"hang",
     [](const ReaderRequest&) {
         if (const char* file = std::getenv("SANDBOX_CHILD_PID"))
             std::ofstream(file) << ::getpid() << std::endl;
         for (;;)
             ::pause();
     }},
    {"hang-confined",
     [](const ReaderRequest& request) {
         dieWith(request.parent);
         if (const char* file = std::getenv("SANDBOX_CHILD_PID"))
             std::ofstream(file) << ::getpid() << std::endl;
         for (;;)
             ::pause();
     }},
    {"deaf",
     [](const ReaderRequest&) {
         ::close(0); // keeps running
         for (;;)
             ::pause();
     }},
    {"eat",
     [](const ReaderRequest& request) {
         limitTo(budgetFor(request.limits, 0, 0), budgetFor(request.limits, SIZE_MAX, SIZE_MAX));
         std::set_new_handler([] { ::_exit(kNoMemoryCode); });
         for (;;)
             std::memset(new char[1 << 20], 1, 1 << 20);
     }},
    {"garbage",
     [](const ReaderRequest&) {
         std::mt19937 random(7);
         std::vector<std::byte> bytes(1 << 20);
         for (std::byte& b : bytes)
             b = std::byte(random());
         sendAll(bytes);
     }},
    {"half",
     [](const ReaderRequest&) {
         const auto bytes = sceneBytes(plane());
         sendAll(std::span(bytes).first(bytes.size() / 2));
     }},
    {"index",
     [](const ReaderRequest&) {
         Scene scene = plane();
         scene.meshes[0].indices[4] = std::uint32_t(scene.meshes[0].vertexCount());
         sendAll(sceneBytes(scene));
     }},
    {"count",
     [](const ReaderRequest&) {
         WireOut out(sendAll);
         out.choice(ReaderFrame::value, ReaderFrame::error);
         out.array(std::string("scene"));
         out.number(std::uint64_t(0));
         out.number(std::uint64_t(0));
         out.number(std::uint64_t(1)); // announces a mesh of 3 GB of positions, and sends none
         out.array(std::string("mesh"));
         out.number(int(0));
         out.number(std::uint64_t(1) << 28);
         out.flush();
     }},
    {"picture",
     [](const ReaderRequest&) {
         const Claim claim = claimed();
         WireOut out(sendAll);
         out.choice(ReaderFrame::value, ReaderFrame::error);
         exchangeImage(out, claim);
         out.flush();
     }},
    {"rows", // answers one request for rows
     [](const ReaderRequest&) {
         const Claim claim = claimed();
         WireOut out(sendAll);
         out.choice(ReaderFrame::value, ReaderFrame::error);
         exchangeRowFacts(out, claim);
         out.flush();
         std::int32_t requested = 0;
         if (::recv(0, &requested, sizeof requested, MSG_WAITALL) != sizeof requested)
             return;
         out.choice(ReaderFrame::value, ReaderFrame::error);
         out.array(claim.data);
         out.flush();
     }},
    {"flood",
     [](const ReaderRequest&) {
         const std::string line(1000, 'x');
         for (int i = 0; i < 10'000; ++i)
             std::fputs(line.c_str(), stderr);
         sendAll(sceneBytes(plane()));
     }},
    {"expect", [](const ReaderRequest&) { expectFor([] { return true; }); }},
    {"lines", [](const ReaderRequest&) { answerError("two\nlines\x1b[2J" + std::string(100'000, 'x')); }},
    {"powers",
     [](const ReaderRequest& request) {
         confine();
         answerError("can:" + powers(request) + ".");
     }},
    {"calls",
     [](const ReaderRequest&) {
         confine();
         answerError("not refused:" + notRefused() + ".");
     }},
    {"descriptors", [](const ReaderRequest&) { answerError("open:" + openDescriptors() + "."); }},
};

} // namespace

int main(int argc, char** argv)
{
    const char* act = std::getenv("SANDBOX_CHILD_DOES");
    if (!cotan::isReaderProcess(argc, argv))
        return 1;
    if (!act)
        return cotan::runReaderProcess();
    if (std::string(act) == "unread")
        return 0;
    kActs.at(act)(takeRequest());
}
