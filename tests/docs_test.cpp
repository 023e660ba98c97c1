// Checks the documents: links, the names and options in them, and the numbers that they repeat from measured tables.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "run_tool.hpp"

namespace cotan::test {
namespace {

namespace fs = std::filesystem;

const fs::path kSources = COTAN_SOURCE_DIR;

std::vector<fs::path> documents()
{
    std::vector<fs::path> files = {kSources / "README.md", kSources / "CONTRIBUTING.md", kSources / "SECURITY.md",
                                   kSources / "CHANGELOG.md"};
    for (const char* folder : {"docs", "examples"})
        for (const auto& entry : fs::recursive_directory_iterator(kSources / folder))
            if (entry.path().extension() == ".md")
                files.push_back(entry.path());
    for (const char* package : {"js", "python"})
        files.push_back(kSources / "bindings" / package / "README.md");
    return files;
}

std::string shortName(const fs::path& file) { return file.lexically_relative(kSources).string(); }

// The hand-written part of a page: up to the mark after which `cotan cost` writes its tables.
std::string writtenPart(const fs::path& file)
{
    const std::string text = readWhole(file);
    return text.substr(0, text.find("<!-- cotan cost: from here"));
}

// A text with whitespace folded to single spaces, so that phrases are found across line breaks.
std::string folded(const std::string& text)
{
    std::string result;
    for (char c : text)
        if (!std::isspace(static_cast<unsigned char>(c)))
            result += c;
        else if (!result.empty() && result.back() != ' ')
            result += ' ';
    return result;
}

std::vector<std::string> matches(const std::string& text, const std::regex& pattern, std::size_t group)
{
    std::vector<std::string> found;
    for (auto it = std::sregex_iterator(text.begin(), text.end(), pattern); it != std::sregex_iterator(); ++it)
        found.push_back((*it)[group]);
    return found;
}

// The anchor of a heading, as web hosts generate it.
std::string anchorOf(const std::string& heading)
{
    std::string anchor;
    for (char c : heading)
        if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_')
            anchor += char(std::tolower(static_cast<unsigned char>(c)));
        else if (c == ' ')
            anchor += '-';
    return anchor;
}

bool hasAnchor(const fs::path& file, const std::string& anchor)
{
    std::istringstream text(readWhole(file));
    for (std::string line; std::getline(text, line);)
        if (line.starts_with('#') && anchorOf(line.substr(line.find_first_not_of("# "))) == anchor)
            return true;
    return false;
}

TEST(Documents, everyLinkPointsToAFileAndAHeading)
{
    const std::regex link(R"(\]\(([^)\s]+)\))");
    std::size_t checked = 0;
    for (const fs::path& file : documents())
        for (const std::string& target : matches(readWhole(file), link, 1)) {
            if (target.starts_with("http"))
                continue;
            const std::size_t hash = target.find('#');
            const std::string path = target.substr(0, hash);
            const fs::path there = path.empty() ? file : file.parent_path() / path;
            EXPECT_TRUE(fs::exists(there)) << shortName(file) << ": " << target;
            if (hash != std::string::npos && fs::exists(there)) {
                EXPECT_TRUE(hasAnchor(there, target.substr(hash + 1))) << shortName(file) << ": " << target;
            }
            ++checked;
        }
    EXPECT_GT(checked, 30u);
}

// The only page whose tables of files may still be wider.
const std::set<std::string> kPagesWithWideTables = {"docs/project/architecture.md"};

std::size_t columnsOf(const std::string& line) // counts UTF-8 characters
{
    return std::size_t(
        std::ranges::count_if(line, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

TEST(Documents, noLineIsOverTheLimit)
{
    constexpr std::size_t kMaxColumns = 120;
    const std::set<std::string> generated = {"docs/reference/javascript.md"}; // contains type declarations verbatim
    for (const fs::path& file : documents()) {
        const std::string name = shortName(file);
        if (generated.contains(name) || name == "CHANGELOG.md")
            continue;
        std::istringstream text(writtenPart(file));
        for (std::string line; std::getline(text, line);)
            if (!(line.starts_with('|') && kPagesWithWideTables.contains(name))) {
                EXPECT_LE(columnsOf(line), kMaxColumns) << name << ": " << line;
            }
    }
}

// A merge conflict leaves both versions between marks until it is resolved.
TEST(Sources, haveNoMarksOfAnUnfinishedMerge)
{
    std::size_t read = 0;
    for (const fs::directory_entry& top : fs::directory_iterator(kSources)) {
        std::vector<fs::path> files;
        if (top.is_regular_file())
            files.push_back(top.path());
        else if (top.is_directory() && top.path().filename() != "build" && top.path().filename() != ".git")
            for (const fs::directory_entry& entry : fs::recursive_directory_iterator(top.path()))
                if (entry.is_regular_file())
                    files.push_back(entry.path());
        for (const fs::path& file : files) {
            const std::string text = readWhole(file);
            if (text.find('\0') != std::string::npos) // binary: an image or a model
                continue;
            ++read;
            for (const char* word : {"<<<<<<< ", ">>>>>>> "})
                EXPECT_FALSE(text.starts_with(word) || text.find(std::string("\n") + word) != std::string::npos)
                    << shortName(file) << ": " << word;
        }
    }
    EXPECT_GT(read, 1000u);
}

// A page without code and link targets.
std::string proseOf(const fs::path& file)
{
    const std::string text = std::regex_replace(writtenPart(file), std::regex("```[^`]*```"), "");
    return std::regex_replace(text, std::regex(R"(`[^`]*`|\]\([^)]*\))"), "");
}

// Hand-written pages: not those generated from comments and help texts, nor the change log.
std::vector<fs::path> writtenPages()
{
    const std::set<std::string> others = {"docs/reference/c.md", "docs/reference/cpp.md",
                                          "docs/reference/javascript.md", "docs/reference/command-line.md",
                                          "CHANGELOG.md"};
    std::vector<fs::path> pages = documents();
    std::erase_if(pages, [&](const fs::path& file) { return others.contains(shortName(file)); });
    return pages;
}

struct Wording {
    const char *pattern, *better;
};

void expectNone(const fs::path& file, const std::vector<Wording>& wordings)
{
    const std::string text = folded(proseOf(file));
    for (const auto& [pattern, better] : wordings) {
        std::smatch found;
        EXPECT_FALSE(std::regex_search(text, found, std::regex(pattern, std::regex::icase)))
            << shortName(file) << ": '" << found.str() << "'; write " << better;
    }
}

// Phrases that leave the reader guessing.
TEST(Documents, haveNoVaguePhrases)
{
    for (const fs::path& file : writtenPages())
        expectNone(file,
                   {{R"(\bof which\b)", "a sentence of its own"},
                    {R"(\bwhat (it|they) (was|were) (given|told)\b)", "the name of the input"},
                    {R"(\bnobody (knows|would)\b)", "what is unknown"},
                    {R"(\bshuts out\b)", "what is excluded, and by what"},
                    {R"([.!?] Of the )", "the subject first"}});
}

// One idea per paragraph or list item.
TEST(Documents, haveShortParagraphs)
{
    constexpr int kMaxLines = 7;
    const std::regex item(R"(^\s*([-*]|\d+\.)\s)");
    for (const fs::path& file : writtenPages()) {
        std::istringstream text(writtenPart(file));
        int lines = 0;
        bool fenced = false;
        for (std::string line; std::getline(text, line);) {
            fenced ^= line.find("```") != std::string::npos;
            const std::size_t first = line.find_first_not_of(' ');
            if (fenced || first == std::string::npos || std::string("|#<`").find(line[first]) != std::string::npos)
                lines = 0;
            else
                lines = std::regex_search(line, item) ? 1 : lines + 1;
            EXPECT_LE(lines, kMaxLines) << shortName(file) << ": " << line;
        }
    }
}

TEST(Documents, everyImageIsSmallAndUsed)
{
    std::string pages;
    for (const fs::path& file : documents())
        pages += readWhole(file);
    std::size_t checked = 0;
    for (const auto& entry : fs::directory_iterator(kSources / "docs/pictures")) {
        const std::string name = entry.path().filename().string();
        if (name == "make")
            continue;
        EXPECT_LE(entry.file_size(), 300'000u) << name;
        EXPECT_NE(pages.find("pictures/" + name), std::string::npos) << name << " is on no page";
        ++checked;
    }
    EXPECT_GT(checked, 25u);
}

// Every page is reachable from the index or from the page of its folder.
TEST(Documents, theIndexLinksEveryPage)
{
    const std::string index = readWhole(kSources / "docs/README.md");
    for (const auto& entry : fs::recursive_directory_iterator(kSources / "docs"))
        if (entry.path().extension() == ".md" && entry.path().filename() != "README.md") {
            const std::string page = entry.path().lexically_relative(kSources / "docs").string();
            EXPECT_NE(index.find("(" + page + ")"), std::string::npos) << page;
        }
}

// The first screen of the README has what artists and bakers look for.
TEST(Documents, theReadmeShowsEarlyHowToFlipGreenAndBake)
{
    std::istringstream text(readWhole(kSources / "README.md"));
    std::size_t number = 0, green = 0, bake = 0;
    for (std::string line; std::getline(text, line);) {
        ++number;
        if (green == 0 && line.starts_with("cotan map convert")
            && line.find("rock.png --to opengl") != std::string::npos)
            green = number;
        if (bake == 0 && line.starts_with("cotan bake"))
            bake = number;
    }
    EXPECT_TRUE(green > 0 && green <= 25) << green;
    EXPECT_TRUE(bake > 0 && bake <= 40) << bake;
    EXPECT_LE(number, 120u);
}

// The map for Unity: the README up to the link to the page, plus the page up to the command and the setting.
TEST(Documents, theReadmeShowsTheMapForUnityWithinSixtyLines)
{
    const auto linesUntil = [](const char* page, const char* words) {
        const std::string text = readWhole(kSources / page);
        const std::size_t at = text.find(words);
        EXPECT_NE(at, std::string::npos) << page << ": " << words;
        return 1 + std::count(text.begin(), text.begin() + long(std::min(at, text.size())), '\n');
    };
    EXPECT_LE(
        linesUntil("README.md", "docs/how-to/engines.md") + linesUntil("docs/how-to/engines.md", "**Normal map**"), 60);
    EXPECT_LE(linesUntil("README.md", "docs/how-to/my-engine.md")
                  + linesUntil("docs/how-to/my-engine.md", "## What it costs"),
              150);
}

std::string wholeSource()
{
    std::string all;
    for (const char* folder : {"tests", "src", "shaders", "apps", "examples", "cmake", "bench", "bindings", "fuzz"})
        for (const auto& entry : fs::recursive_directory_iterator(kSources / folder))
            if (entry.is_regular_file() && entry.path().extension() != ".md"
                && entry.path().filename() != "docs_test.cpp" && entry.file_size() < (1u << 20))
                all += readWhole(entry.path());
    return all;
}

// Names such as `FrameBarA1`: tests, types and functions that a reader will look for.
TEST(Documents, everyQuotedNameIsInTheSources)
{
    const std::string sources = wholeSource();
    const std::regex name(R"(`([A-Z][a-z0-9]+[A-Z][A-Za-z0-9]*|cotan_[a-z0-9_]+|COTAN_[A-Z0-9_]+)[(`])");
    // Names of other programs and formats.
    const std::set<std::string> foreign = {"UpperCamel",       "GLTFLoader", "UnpackNormal",
                                           "WebGLRenderer",    "Cotan_half", "ShaderMaterial",
                                           "COTAN_BENCHMARKS", "ValueError", "RuntimeError"};
    std::size_t checked = 0;
    for (const fs::path& file : documents())
        for (const std::string& word : matches(readWhole(file), name, 1)) {
            if (foreign.contains(word))
                continue;
            EXPECT_NE(sources.find(word), std::string::npos) << shortName(file) << " names " << word;
            ++checked;
        }
    EXPECT_GT(checked, 25u);
}

// Paths such as `src/...`, up to a placeholder in capitals such as NAME.
TEST(Documents, everyNamedFileExists)
{
    const std::regex name(R"(`((?:apps|docs|examples|fuzz|include|scripts|shaders|src|tests)/[a-z0-9_./-]*)[`:])");
    std::size_t checked = 0;
    for (const fs::path& file : documents())
        for (const std::string& path : matches(readWhole(file), name, 1)) {
            EXPECT_TRUE(fs::exists(kSources / path)) << shortName(file) << " names " << path;
            ++checked;
        }
    EXPECT_GT(checked, 60u);
}

// Lines of code that call the tool: continued lines joined, comments removed.
std::vector<std::string> callsIn(const std::string& text)
{
    std::vector<std::string> calls;
    std::istringstream lines(std::regex_replace(text, std::regex(R"(\\\n\s*)"), " "));
    bool fenced = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("```"))
            fenced = !fenced;
        const std::regex call(R"(^\s*(?:build/release/bin/)?cotan ([a-z].*)$)");
        std::smatch match;
        if ((fenced || line.starts_with("    ")) && std::regex_match(line, match, call))
            calls.push_back(match[1].str().substr(0, match[1].str().find(" #")));
    }
    for (const std::string& inLine : matches(text, std::regex(R"(`cotan ([a-z][^`\n]*)`)"), 1))
        calls.push_back(inLine);
    return calls;
}

std::string helpOf(const std::vector<std::string>& words)
{
    static std::map<std::vector<std::string>, std::string> known;
    auto [entry, isNew] = known.try_emplace(words);
    if (isNew) {
        std::vector<std::string> asked = words;
        asked.push_back("--help");
        TemporaryFolder folder;
        const ToolRun run = runTool(asked, folder.path());
        entry->second = run.code == 0 ? run.out : "";
    }
    return entry->second;
}

// docs/project/architecture.md has exactly one row for each folder of src, and all of them in the diagram.
TEST(Documents, architectureListsTheSourceFolders)
{
    std::set<std::string> folders, rows;
    for (const auto& entry : fs::directory_iterator(kSources / "src"))
        folders.insert(entry.path().filename().string());
    const std::string plan = readWhole(kSources / "docs/project/architecture.md"),
                      diagram = readWhole(kSources / "docs/project/architecture.svg");
    for (const std::string& row : matches(plan, std::regex("\\n\\| `([a-z_]+)` \\|"), 1))
        rows.insert(row);
    EXPECT_EQ(rows, folders);
    EXPECT_GT(folders.size(), 10u);
    for (const std::string& folder : folders)
        EXPECT_NE(diagram.find(">" + folder + "<"), std::string::npos) << folder;
}

// The output of a shell command that runs in the source folder.
std::string printed(const std::string& command)
{
    std::string text;
    if (FILE* pipe = ::popen(("cd '" + kSources.string() + "' && " + command).c_str(), "r")) {
        for (int c; (c = std::fgetc(pipe)) != EOF;)
            text += char(c);
        ::pclose(pipe);
    }
    return text;
}

// docs/project/extending.md: each heading with a grep is followed by a list of exactly the files that the grep prints.
TEST(Documents, walkThroughsListTheFilesThatNameTheirExample)
{
    const std::string page = readWhole(kSources / "docs/project/extending.md");
    std::size_t checked = 0;
    for (std::size_t at = page.find("\n## "); at != std::string::npos;) {
        const std::size_t next = page.find("\n## ", at + 1);
        const std::string section = page.substr(at, next - at);
        at = next;
        const std::string heading = section.substr(4, section.find('\n', 1) - 4);
        const auto greps = matches(section, std::regex(R"(\n    (grep [^\n]+))"), 1);
        ASSERT_EQ(greps.size(), 1u) << heading;
        const auto listed = matches(section, std::regex(R"(\n- `([^`]+)`:)"), 1);
        std::istringstream found(printed(greps[0]));
        std::set<std::string> files;
        for (std::string file; std::getline(found, file);)
            files.insert(file);
        for (const std::string& file : files)
            EXPECT_TRUE(std::ranges::count(listed, file) == 1) << heading << ": the list lacks " << file;
        for (const std::string& file : listed)
            EXPECT_TRUE(files.contains(file)) << heading << ": nothing is to be done any more in " << file;
        ++checked;
    }
    EXPECT_EQ(checked, 6u);
}

// The command, its subcommand and each --option of the line must be in the help.
TEST(Documents, everyCommandIsAcceptedByTheTool)
{
    std::size_t checked = 0;
    for (const fs::path& file : documents())
        for (const std::string& call : callsIn(readWhole(file))) {
            std::istringstream stream(call);
            std::vector<std::string> words;
            for (std::string word; stream >> word;)
                words.push_back(word);
            std::vector<std::string> command = {words[0]};
            if (words[0] == "map" && words.size() > 1 && std::isalpha(static_cast<unsigned char>(words[1][0])))
                command.push_back(words[1]);
            const std::string help = helpOf(command);
            EXPECT_FALSE(help.empty()) << shortName(file) << ": cotan " << call;
            for (const std::string& word : words)
                if (word.starts_with("--") && word.size() > 2 && !help.empty()) {
                    const std::string option = word.substr(0, word.find('='));
                    EXPECT_TRUE(std::regex_search(help, std::regex(option + "\\b")))
                        << shortName(file) << ": " << option << " in cotan " << call;
                    ++checked;
                }
        }
    EXPECT_GT(checked, 40u);
}

// Which frame is right depends on the map, so that a reader must see the choice. Godot's text has a default.
TEST(Documents, everyShaderCommandNamesItsFrame)
{
    std::size_t checked = 0;
    for (const fs::path& file : documents())
        for (const std::string& call : callsIn(readWhole(file)))
            if (call.starts_with("shader --lang ") && !call.starts_with("shader --lang godot")
                && file.filename() != "CHANGELOG.md") {
                EXPECT_NE(call.find(" --frame "), std::string::npos) << shortName(file) << ": cotan " << call;
                ++checked;
            }
    EXPECT_GT(checked, 10u);
}

// A cell of the line of docs/accuracy.csv that begins with `row`: samples, mean, 95 % or maximum.
double fromAccuracy(const std::string& row, std::size_t column)
{
    std::istringstream lines(readWhole(kSources / "docs/accuracy.csv"));
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(row + ",")) {
            std::istringstream cells(line.substr(row.size() + 1));
            std::string cell;
            for (std::size_t i = 0; i <= column; ++i)
                std::getline(cells, cell, ',');
            return std::stod(cell);
        }
    ADD_FAILURE() << "docs/accuracy.csv has no row " << row;
    return -1;
}

std::string trimmed(const std::string& text)
{
    const std::size_t first = text.find_first_not_of(' ');
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

// A cell by row and GPU, of docs/explanation/cost.md's first table under a heading that begins with `heading`.
double fromCost(const std::string& row, const std::string& column, const std::string& heading = "What perturbing")
{
    bool inside = false;
    std::istringstream lines(readWhole(kSources / "docs/explanation/cost.md"));
    std::vector<std::string> heads;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("#"))
            inside = line.starts_with("### " + heading);
        if (!line.starts_with("|") || !inside)
            heads.clear();
        else {
            std::vector<std::string> cells;
            std::istringstream stream(line.substr(1));
            for (std::string cell; std::getline(stream, cell, '|');)
                cells.push_back(trimmed(cell));
            if (heads.empty() || cells[0].empty()) // makers, then GPUs
                heads = cells;
            const auto at = std::find(heads.begin(), heads.end(), column);
            if (at != heads.end() && cells[0] == row
                && cells[std::size_t(at - heads.begin())].find_first_of("0123456789") != std::string::npos)
                return std::stod(cells[std::size_t(at - heads.begin())]);
        }
    }
    ADD_FAILURE() << "docs/explanation/cost.md has no row " << row << " with " << column;
    return -1;
}

constexpr std::size_t kMean = 1, kMaximum = 3;

std::string flat(const char* layout, const char* frame)
{
    return fmt::format("flat,{},\"domes, frontal\",{},S,double", layout, frame);
}

std::string sphere(int segments, const char* frame)
{
    return fmt::format("curved,sphere,{},{},S,double", segments, frame);
}

// The means of examples/three/README.md's real models, read with `orthonormal`; of a model with two kinds of maps the
// larger one. tests/web/three_defaults_test.mjs measures the table again.
std::vector<double> fromThree()
{
    const std::string page = readWhole(kSources / "examples/three/README.md");
    const std::regex row(
        R"(\n\| [^|\n]+ \| (?:stored|made by three)[^|\n]* \| ([0-9.]+), [0-9.]+(?:; ([0-9.]+), [0-9.]+)? \|)");
    std::vector<double> means;
    for (auto it = std::sregex_iterator(page.begin(), page.end(), row); it != std::sregex_iterator(); ++it)
        means.push_back(std::max(std::stod((*it)[1]), (*it)[2].matched ? std::stod((*it)[2]) : 0));
    EXPECT_GE(means.size(), 8u);
    return means;
}

// The means of docs/explanation/models.md, with what untangle() decides. tests/web/models_table_test.mjs compares the
// page with what was measured.
std::vector<double> fromModels()
{
    const std::string page = readWhole(kSources / "docs/explanation/models.md");
    const std::regex row(R"(\n\| [^|\n]+ \|(?: [0-9.]* \|){2} ([0-9.]+) \|(?: [0-9.]+ \|){3} -?[0-9]+ \| [0-9]+ \|)");
    std::vector<double> means;
    for (auto it = std::sregex_iterator(page.begin(), page.end(), row); it != std::sregex_iterator(); ++it)
        means.push_back(std::stod((*it)[1]));
    EXPECT_EQ(means.size(), 30u);
    return means;
}

// A phrase of a document whose numbers come from tables; each {} is one number.
struct Claim {
    const char* document;
    const char* phrase;
    std::vector<double> numbers;
    int decimals = 0;
};

std::string filled(const Claim& claim)
{
    std::string text;
    auto number = claim.numbers.begin();
    for (const char* c = claim.phrase; *c; ++c)
        if (c[0] == '{' && c[1] == '}') {
            text += fmt::format("{:.{}f}", *number++, claim.decimals);
            ++c;
        } else
            text += *c;
    return text;
}

TEST(Documents, numbersMatchTheMeasuredTables)
{
    auto over = [](const char* row) { return fromCost(row, "NAVI21"); };
    auto onGpus = [](const char* row, const char* heading = "What perturbing") {
        std::vector<double> numbers;
        for (const char* gpu : {"NAVI21", "Ada", "DG2", "Adreno 750", "Mali-G610", "M1"})
            numbers.push_back(fromCost(row, gpu, heading));
        return numbers;
    };
    // Instructions on three GPUs, and the bound in cycles on the first.
    auto ofTriangle = [](const char* row) {
        std::vector<double> numbers;
        for (const char* gpu : {"NAVI21", "NAVI31", "POLARIS10"})
            numbers.push_back(fromCost(row, gpu));
        numbers.push_back(fromCost(row, "NAVI21", "Whole fragment shaders, bound"));
        return numbers;
    };
    const std::vector<double> models = fromThree(), decided = fromModels();
    const double worst = std::ranges::max(models),
                 small = double(std::ranges::count_if(models, [](double mean) { return mean < 0.1; })),
                 count = double(models.size());
    const Claim claims[] = {
        {"README.md",
         "against three.js with tangents | {} to {} mean on 30 models | 0 |",
         {std::ranges::min(decided), std::ranges::max(decided)},
         2},
        {"README.md", "is below 0.1 degrees on {} of [{} models](examples/three/README.md#measured),", {small, count}},
        {"README.md", "#measured), and {} on the worst.", {worst}, 2},
        {"docs/how-to/choose-a-frame.md", "| `orthonormal` | right | below 0.1 on {} of {} models,", {small, count}},
        {"docs/how-to/choose-a-frame.md", "models, worst {} |", {worst}, 2},
        {"docs/how-to/my-engine.md",
         "| `orthonormal` | nothing | {} to {} | the same |",
         {std::ranges::min(models), worst},
         2},
        {"docs/explanation/triangle.md", "| `mikktspace` | +{} | +{} | +{} | {} |", ofTriangle("mikktspace")},
        {"docs/explanation/triangle.md", "| `triangle`, six halfs | **+{}** | **+{}** | +{} | **{}** |",
         ofTriangle("triangle-halfs")},
        {"docs/explanation/triangle.md", "| `triangle`, six floats | +{} | +{} | **+{}** | {} |",
         ofTriangle("triangle-fused")},
        {"docs/explanation/triangle.md", "| `smooth`, fused | +{} | +{} | **+{}** | {} |", ofTriangle("smooth-fused")},
        {"docs/explanation/triangle.md", "| `cotangent`, fused | +{} | +{} | +{} | {} |",
         ofTriangle("cotangent-fused")},
        {"docs/explanation/triangle.md", "| `cotangent`, n on the side that is seen | +{} | +{} | +{} | {} |",
         ofTriangle("cotangent-seen")},
        {"docs/explanation/triangle.md",
         "costs {} instructions more a pixel, or {} if U and V are read. Stored tangents cost {},",
         {fromCost("triangle-fused", "NAVI21", "What a frame adds where a visibility buffer"),
          fromCost("triangle-read", "NAVI21", "What a frame adds where a visibility buffer"),
          fromCost("mikktspace", "NAVI21", "What a frame adds where a visibility buffer")}},
        {"docs/explanation/triangle.md",
         "costs {} instructions more if 24 bytes are stored, {} for 8 bytes, {} for 4.",
         {fromCost("two cotangents", "NAVI21", "What stored tangents add"),
          fromCost("two cotangents in 8 bytes", "NAVI21", "What stored tangents add"),
          fromCost("two cotangents in 4 bytes", "NAVI21", "What stored tangents add")}},
        {"docs/explanation/triangle.md",
         "Each vertex costs {} instructions more, where a stored tangent costs {},",
         {fromCost("triangle, six halfs", "NAVI21", "What stored tangents add"),
          fromCost("tangent", "NAVI21", "What stored tangents add")}},
        {"README.md",
         "| flat patch, square texels, against the exact slope | {} degrees | {} degrees |",
         {fromAccuracy(flat("square", "cotangent"), kMean), fromAccuracy(flat("square", "mikktspace"), kMean)},
         2},
        {"README.md",
         "against the slope that follows the stretch | {} |",
         {fromAccuracy(flat("stretch 2:1", "cotangent"), kMean)},
         2},
        {"README.md",
         "sheared by 45 degrees, the same | {} |",
         {fromAccuracy(flat("shear 45", "cotangent"), kMean)},
         2},
        {"README.md",
         "stretched 2:1, against the slope that follows the stretch | 0.00 | {} mean, {} at most |",
         {fromAccuracy(flat("stretch 2:1", "mikktspace"), kMean),
          fromAccuracy(flat("stretch 2:1", "mikktspace"), kMaximum)},
         1},
        {"README.md",
         "| flat patch sheared by 45 degrees, the same | 0.00 | {} mean, {} at most |",
         {fromAccuracy(flat("shear 45", "mikktspace"), kMean), fromAccuracy(flat("shear 45", "mikktspace"), kMaximum)},
         1},
        {"README.md",
         "| sphere of 32 segments, against the smooth surface | {} (`triangle`) | {} |",
         {fromAccuracy(sphere(32, "triangle"), kMean), fromAccuracy(sphere(32, "mikktspace"), kMean)},
         2},
        {"README.md",
         "| the same sphere, against the displaced surface | {} (`triangle`) | {} |",
         {fromAccuracy("curved,sphere,32,triangle,E,double", kMean),
          fromAccuracy("curved,sphere,32,mikktspace,E,double", kMean)},
         2},
        {"README.md",
         "| the same with square texels, against the smooth surface | {} (`triangle`) | {} |",
         {fromAccuracy("curved,mercator,32,triangle,S,double", kMean),
          fromAccuracy("curved,mercator,32,mikktspace,S,double", kMean)},
         2},
        {"README.md",
         "| `orthonormal` {}, {}, {}; `smooth` {}, {}, {} | {}, {}, {} |",
         {over("orthonormal-fused"), fromCost("orthonormal-fused", "Ada"), fromCost("orthonormal-fused", "Mali-G610"),
          over("smooth-fused"), fromCost("smooth-fused", "Ada"), fromCost("smooth-fused", "Mali-G610"),
          over("mikktspace"), fromCost("mikktspace", "Ada"), fromCost("mikktspace", "Mali-G610")}},
        {"docs/how-to/my-engine.md", "| `mikktspace` | +{} | +{} | +{} | +{} | +{} | +{} |", onGpus("mikktspace")},
        {"docs/how-to/my-engine.md", "| `smooth`, fused | +{} | +{} | +{} | +{} | +{} | +{} |", onGpus("smooth-fused")},
        {"docs/how-to/my-engine.md", "| `triangle`, packed in halfs | +{} | +{} | +{} | +{} | +{} | +{} |",
         onGpus("triangle-halfs")},
        {"docs/how-to/my-engine.md", "| `triangle`, in floats | +{} | +{} | +{} | +{} | +{} | +{} |",
         onGpus("triangle-fused")},
        {"docs/how-to/my-engine.md", "| `cotangent`, normal on the seen side | +{} | +{} | +{} | +{} | +{} | +{} |",
         onGpus("cotangent-seen")},
        {"docs/how-to/my-engine.md", "| `cotangent`, fused | +{} | +{} | +{} | +{} | +{} | +{} |",
         onGpus("cotangent-fused")},
        {"docs/how-to/my-engine.md", "| `orthonormal`, fused | +{} | +{} | +{} | +{} | +{} | +{} |",
         onGpus("orthonormal-fused")},
        {"docs/how-to/my-engine.md", "| `mikktspace`, resolved | +{} | +{} | +{} | +{} | +{} | +{} |",
         onGpus("mikktspace", "What a frame adds where a visibility buffer")},
        {"docs/how-to/my-engine.md", "| `triangle`, read | +{} | +{} | +{} | +{} | +{} | +{} |",
         onGpus("triangle-read", "What a frame adds where a visibility buffer")},
        {"docs/how-to/my-engine.md", "| `cotangent`, resolved | +{} | +{} | +{} | +{} | +{} | +{} |",
         onGpus("cotangent-fused", "What a frame adds where a visibility buffer")},
        {"docs/explanation/degrees.md",
         "`triangle` is {} degrees off and MikkTSpace {}, by truth S.",
         {fromAccuracy(sphere(32, "triangle"), kMean), fromAccuracy(sphere(32, "mikktspace"), kMean)},
         2},
        {"docs/explanation/cost.md",
         "On NAVI21 totality costs {} instructions more",
         {over("cotangent") - over("cotangent-fused")}},
        {"docs/explanation/baking.md",
         "second order: {} degrees on a sphere of 32 segments where `cotangent` has {}",
         {fromAccuracy(sphere(32, "smooth"), kMean), fromAccuracy(sphere(32, "cotangent"), kMean)},
         2},
        {"docs/project/testing.md",
         "{}/{}/{}/{};",
         {fromAccuracy(sphere(16, "cotangent"), kMean), fromAccuracy(sphere(32, "cotangent"), kMean),
          fromAccuracy(sphere(64, "cotangent"), kMean), fromAccuracy(sphere(128, "cotangent"), kMean)},
         2},
        {"docs/project/testing.md",
         "| {}/{}; 0 | `AccuracyBarB2`",
         {fromAccuracy(sphere(32, "smooth"), kMean), fromAccuracy(sphere(64, "smooth"), kMean)},
         2},
    };
    const std::string readme = folded(readWhole(kSources / "README.md"));
    std::vector<bool> claimed(readme.size());
    for (const Claim& claim : claims) {
        const std::string expected = filled(claim), text = folded(readWhole(kSources / claim.document));
        const std::size_t at = text.find(expected);
        EXPECT_NE(at, std::string::npos) << claim.document << " should say: " << expected;
        if (at != std::string::npos && text == readme)
            std::fill_n(claimed.begin() + std::ptrdiff_t(at), expected.size(), true);
    }
    // Versions have two points. "0.1 degrees" is the limit that the models are counted by, and is in its claim.
    const std::regex decimal(R"((?:^|[^0-9.])([0-9]+\.[0-9]+)(?![0-9.]))");
    for (auto it = std::sregex_iterator(readme.begin(), readme.end(), decimal); it != std::sregex_iterator(); ++it)
        EXPECT_TRUE(claimed[std::size_t(it->position(1))]) << "no table has README.md's number " << (*it)[1];
}

} // namespace
} // namespace cotan::test
