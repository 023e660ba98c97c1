#include "files/output.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "core/named_values.hpp"
#include "core/try.hpp"
#include "files/file_registry.hpp"
#include "files/system/system.hpp"

namespace cotan {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kPartStart = ".cotan-", kPartMark = ".part";

// Eight hex digits that identify a machine or a container. Several may share a folder.
const std::string& machine()
{
    static const std::string digits = [] {
        std::uint32_t hash = 2166136261; // FNV-1a
        for (const char c : machineName())
            hash = (hash ^ static_cast<unsigned char>(c)) * 16777619;
        return fmt::format("{:08x}", hash);
    }();
    return digits;
}

// A temporary name, unique among the machines that share the folder, their processes, and this process's threads.
// Short, so that it fits wherever the file's own name does.
fs::path partBeside(const fs::path& file)
{
    static std::atomic<unsigned> counter{0};
    const std::string extension = file.extension().string();
    return folderOf(file)
        / fmt::format("{}{}-{}-{}{}{}", kPartStart, thisProcess(), counter.fetch_add(1), machine(), kPartMark,
                      extension.size() <= 16 ? extension : "");
}

// The process of this machine in a temporary file's name; 0 for other names.
pid_t processOf(const std::string& name)
{
    if (!name.starts_with(kPartStart) || name.find("-" + machine() + std::string(kPartMark)) == std::string::npos)
        return 0;
    pid_t process = 0;
    const auto [end, error] = std::from_chars(name.data() + kPartStart.size(), name.data() + name.size(), process);
    return error == std::errc() && *end == '-' && process > 0 ? process : 0;
}

// The temporary files of this machine's processes in a folder, with their processes.
std::vector<std::pair<fs::path, pid_t>> partsIn(const fs::path& folder)
{
    std::vector<std::pair<fs::path, pid_t>> parts;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
        if (const pid_t process = processOf(at->path().filename().string()); process != 0)
            parts.emplace_back(at->path(), process);
    return parts;
}

// /dev/stdout and the like are links to open files of any kind.
bool isSpecial(const fs::path& file)
{
    std::error_code ignored;
    if (isNameOfDevice(file))
        return true;
    const fs::file_status status = fs::status(file, ignored);
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

// Follows symbolic links, even to a missing target; other files are returned unchanged.
fs::path linkTarget(fs::path file)
{
    constexpr int kMaxLinks = 40; // as in Linux
    std::error_code error;
    for (int i = 0; i < kMaxLinks && fs::is_symlink(fs::symlink_status(file, error)); ++i) {
        const fs::path target = fs::read_symlink(file, error);
        if (error)
            break;
        file = folderOf(file) / target; // an absolute target replaces the folder
    }
    return file;
}

// The device that Windows takes this name for, so that it cannot be a file: "CON" for "folder/con.png". It does so in
// every folder, whatever the extension, and drops spaces at the end. Empty for other names.
std::string reservedName(const fs::path& file)
{
    if (!onWindows())
        return {};
    std::string name = file.filename().string();
    name = name.substr(0, name.find_first_of(".:"));
    name = name.substr(0, name.find_last_not_of(' ') + 1);
    std::ranges::transform(name, name.begin(), upperLetter);
    const bool numbered =
        name.size() == 4 && (name.starts_with("COM") || name.starts_with("LPT")) && name[3] >= '1' && name[3] <= '9';
    const bool named =
        name == "CON" || name == "PRN" || name == "AUX" || name == "NUL" || name == "CONIN$" || name == "CONOUT$";
    return numbered || named ? name : "";
}

Status checkName(const fs::path& file)
{
    if (const std::string device = reservedName(file); !device.empty())
        return outputError(
            fmt::format("{}: expected a name for a file, found the name of the device {}", file.string(), device));
    return Done{};
}

Error cannotWrite(const fs::path& file, int number)
{
    return outputError(fmt::format("{}: cannot write: {}", file.string(), reasonOf(number)));
}

void replaceAll(std::string& text, const std::string& from, const std::string& to)
{
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
}

// Writes and closes. Returns 0 or the errno.
int writeAll(OpenFile file, const ByteBlocks& blocks)
{
    int number = 0;
    for (std::span<const std::byte> bytes : blocks)
        while (!bytes.empty() && number == 0) {
            const std::ptrdiff_t written = writeSome(file.get(), bytes.data(), bytes.size());
            if (written > 0)
                bytes = bytes.subspan(std::size_t(written));
            else if (written == 0 || errno != EINTR)
                number = written == 0 ? ENOSPC : errno;
        }
    return std::fclose(file.release()) != 0 && number == 0 ? errno : number;
}

} // namespace

std::string reasonOf(int number)
{
    if (meansFull(number))
        return "no space left on the device";
    if (number == EFBIG)
        return "no space left: the file would exceed the file size limit (ulimit -f)";
    std::string text = std::generic_category().message(number);
    if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z')
        text[0] = char(text[0] + 'a' - 'A');
    return text;
}

OutputFile::OutputFile(fs::path file, fs::path part, bool special)
    : file_(std::move(file)), part_(std::move(part)), special_(special), guard_(special ? fs::path() : part_)
{
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : file_(std::move(other.file_)), part_(std::move(other.part_)), special_(other.special_),
      gone_(std::exchange(other.gone_, true)), guard_(std::move(other.guard_))
{
}

OutputFile::~OutputFile()
{
    std::error_code ignored;
    if (!gone_ && !special_)
        fs::remove(part_, ignored);
}

Result<OutputFile> OutputFile::begin(const fs::path& name)
{
    std::error_code ignored;
    const fs::path file = isSpecial(name) ? name : linkTarget(name);
    if (!fs::is_directory(folderOf(file), ignored))
        return outputError(fmt::format("{}: the folder {} does not exist", file.string(), folderOf(file).string()));
    if (fs::is_directory(file, ignored))
        return outputError(fmt::format("{}: is a folder", file.string()));
    COTAN_CHECK(checkName(file));
    COTAN_CHECK(beginOutput(file));
    const bool special = isSpecial(file);
    return OutputFile(file, special ? file : partBeside(file), special);
}

Result<OpenFile> OutputFile::open(bool reads) const
{
    OpenFile file(openStream(part_, reads ? "w+b" : "wb"));
    if (!file)
        return cannotWrite(file_, errno);
    return file;
}

Status OutputFile::commit()
{
    COTAN_CHECK(mayAppear(file_));
    std::error_code failed;
    if (!special_)
        fs::rename(part_, file_, failed);
    if (failed) {
        blockWhileEnding();
        return cannotWrite(file_, failed.default_error_condition().value());
    }
    gone_ = true;
    endOutput(file_);
    return Done{};
}

Error OutputFile::failed(const Error& error) const
{
    blockWhileEnding();
    if (error.kind != ErrorKind::output)
        return error;
    if (!special_) { // a trial
        static constexpr std::array<std::byte, 65536> kNothing{};
        OpenFile part(openStream(part_, "ab"));
        if (const int number = part ? writeAll(std::move(part), {kNothing}) : errno)
            return cannotWrite(file_, number);
    }
    Error forUser = error;
    replaceAll(forUser.message, part_.string(), file_.string());
    replaceAll(forUser.message, part_.filename().string(), file_.filename().string());
    return forUser;
}

Status commitTogether(std::span<OutputFile> files)
{
    const InterruptsHeld held;
    std::vector<fs::path> made; // destinations where no file existed
    for (OutputFile& file : files) {
        std::error_code ignored;
        const bool isNew = !fs::exists(fs::symlink_status(file.destination(), ignored));
        if (Status done = file.commit(); !done) {
            for (const fs::path& path : made)
                fs::remove(path, ignored);
            return done;
        }
        if (isNew)
            made.push_back(file.destination());
    }
    return Done{};
}

Status writeBytes(const OutputFile& file, const ByteBlocks& blocks)
{
    COTAN_TRY(stream, file.open());
    const int number = writeAll(*std::move(stream), blocks);
    return number == 0 ? Status(Done{}) : cannotWrite(file.destination(), number);
}

Status writeFileWhole(const fs::path& file, std::string_view text)
{
    COTAN_TRY(output, OutputFile::begin(file));
    if (Status written = writeBytes(*output, {std::as_bytes(std::span(text.data(), text.size()))}); !written)
        return output->failed(written.error());
    return output->commit();
}

Status checkWritable(const fs::path& file, bool makesFolder)
{
    std::error_code ignored;
    if (fs::is_directory(file, ignored))
        return outputError(fmt::format("{}: is a folder", file.string()));
    if (isSpecial(file))
        return mayWrite(file) ? Status(Done{}) : cannotWrite(file, errno);
    fs::path folder = folderOf(file);
    while (makesFolder && !fs::exists(fs::symlink_status(folder, ignored)) && folder != folderOf(folder))
        folder = folderOf(folder);
    if (!fs::is_directory(folder, ignored))
        return outputError(makesFolder
                               ? fmt::format("{}: cannot create a folder: {} is a file", file.string(), folder.string())
                               : fmt::format("{}: the folder {} does not exist", file.string(), folder.string()));
    COTAN_CHECK(checkName(file));
    if (!mayWrite(folder))
        return outputError(
            fmt::format("{}: cannot write in the folder {}: {}", file.string(), folder.string(), reasonOf(errno)));
    return Done{};
}

void removeParts(const fs::path& folder, pid_t process)
{
    std::error_code ignored;
    for (const auto& [part, owner] : partsIn(folder))
        if (owner == process)
            fs::remove(part, ignored);
}

std::vector<fs::path> leftParts(const fs::path& folder)
{
    std::vector<fs::path> parts;
    for (const auto& [part, owner] : partsIn(folder))
        if (!isRunning(owner))
            parts.push_back(part);
    return parts;
}

Status makeFolder(const fs::path& folder)
{
    std::error_code error;
    fs::create_directories(folder, error);
    if (!fs::is_directory(folder))
        return outputError(fmt::format("{}: cannot create this folder: {}", folder.string(),
                                       error ? error.message() : "a file has this name"));
    return Done{};
}

} // namespace cotan
