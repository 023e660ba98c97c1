// The report of a batch in a browser.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "batch/report.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

using namespace test;
using nlohmann::json;

struct PageInput {
    JobList list{"/jobs", {}};
    std::vector<JobResult> results;

    void add(const std::string& name, JobState state, std::optional<Degrees> degrees)
    {
        Job job;
        job.name = name;
        job.words = {"lint", name + ".glb"};
        list.jobs.push_back(job);
        JobResult result{results.size(), {}, false};
        result.record.state = state;
        result.record.reason = state == JobState::done ? "" : "reason of " + name;
        result.record.degrees = degrees;
        result.record.outputs = {{"out/" + name, "00"}};
        results.push_back(result);
    }
};

// The JSON that `script`, run at the end of the page, puts into the page's title.
json titleAfter(const PageInput& input, const std::string& script)
{
    TemporaryFolder folder;
    std::string page = batchPage(input.list, input.results, "jobs", "footer", "/report", 100000);
    page.insert(page.find("</body>"),
                "<script>document.title = 'RESULT' + JSON.stringify((() => {" + script + "})());</script>");
    std::ofstream(folder / "page.html") << page;
    const std::string f = folder.path().string();
    const std::string line =
        fmt::format("timeout 100 chromium --headless --no-sandbox --disable-gpu --user-data-dir='{0}/profile' "
                    "--window-size=1000,800 --dump-dom 'file://{0}/page.html' > '{0}/dom' 2> '{0}/log'",
                    f);
    const int code = std::system(line.c_str());
    const std::string dom = readWhole(folder / "dom");
    const std::size_t begin = dom.find("<title>RESULT"), end = dom.find("</title>", begin);
    if (begin == std::string::npos)
        return {{"error", fmt::format("chromium printed no result, exit {}: {}", code, dom.substr(0, 80))}};
    std::string text = dom.substr(begin + 13, end - begin - 13);
    for (const auto& [from, to] : {std::pair("&lt;", "<"), {"&gt;", ">"}, {"&amp;", "&"}})
        for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; ++at)
            text.replace(at, std::string_view(from).size(), to);
    return json::parse(text);
}

bool noBrowser() { return std::system("command -v chromium > /dev/null 2>&1") != 0; }

TEST(BatchPage, onlyVisibleRowsExistAndTheyFilterAndSort)
{
    if (noBrowser())
        GTEST_SKIP() << "no chromium";
    PageInput input;
    for (int i = 0; i < 10000; ++i)
        input.add(fmt::format("rock {}", i), i % 100 == 7 ? JobState::crashed : JobState::done,
                  i % 2 ? std::optional<Degrees>(Degrees{i / 100.0, "of"}) : std::nullopt);
    json got = titleAfter(input, R"(
        const names = () => [...document.querySelectorAll('#space .name')].map(e => e.textContent);
        const result = { rows: names().length, first: names()[0], height: space.offsetHeight };
        find.value = 'ROCK 99'; find.dispatchEvent(new Event('input'));
        result.found = shown.length;
        find.value = ''; find.dispatchEvent(new Event('input'));
        const press = column => document.querySelector(`[data-column="${column}"]`).click();
        press(2); result.most = names()[0];
        press(2); result.least = names()[0];
        press(0); result.byName = names().slice(0, 3);
        press(0); press(0); result.again = names()[0];
        document.querySelector('[data-state="7"]').click(); result.crashed = shown.length;
        list.scrollTop = 50 * 64; draw(false); result.scrolled = names().includes('rock 5007');
        return result;)");
    EXPECT_LT(got.value("rows", 10000), 60) << got;
    EXPECT_GT(got.value("rows", 0), 5) << got;
    EXPECT_EQ(got["first"], "rock 9907") << "crashed, with the most degrees";
    EXPECT_EQ(got["height"], 640000);
    EXPECT_EQ(got["found"], 280) << "numbers of four digits with two nines beside each other: 3 * 100 - 21 + 1";
    EXPECT_EQ(got["most"], "rock 9999");
    EXPECT_EQ(got["least"], "rock 1");
    EXPECT_EQ(got["byName"], json({"rock 0", "rock 1", "rock 2"})) << "numbers as numbers";
    EXPECT_EQ(got["again"], got["first"]);
    EXPECT_EQ(got["crashed"], 100);
    EXPECT_EQ(got["scrolled"], true);
}

TEST(BatchPage, jobNamesAreShownAsTextAndNeverExecuted)
{
    if (noBrowser())
        GTEST_SKIP() << "no chromium";
    const std::string evil =
        "</script><script>window.ran = 1</script><img src=x onerror='window.ran = 2'><!-- <script> ü\"&";
    PageInput input;
    input.add(evil, JobState::failed, Degrees{1, evil});
    input.results[0].record.output = evil;
    input.results[0].record.thumbnail = {1, 1, "\" onerror=\"window.ran = 3"};
    json got = titleAfter(input, R"(
        document.querySelector('#space .row').click();
        return { name: document.querySelector('#space .name').textContent, ran: window.ran || 0,
                 heading: document.querySelector('dialog h2').textContent, open: document.querySelector('dialog').open,
                 link: document.querySelector('dialog a').href, bad: document.querySelectorAll('.row.bad').length };)");
    EXPECT_EQ(got["name"], evil);
    EXPECT_EQ(got["heading"], evil);
    EXPECT_EQ(got["ran"], 0);
    EXPECT_EQ(got["open"], true);
    EXPECT_EQ(got["bad"], 1);
    EXPECT_NE(got["link"].get<std::string>().find("/jobs/out/%3C/script%3E"), std::string::npos) << got;
}

} // namespace
} // namespace cotan
