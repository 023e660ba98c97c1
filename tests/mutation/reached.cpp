// Linked into each test program that scripts/mutants builds: records the planted mistakes that each test reaches.
#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <string>

namespace {

constexpr int kBytesOfReachedMutants = 4096; // as in plant.py

class ReachedMutants : public ::testing::EmptyTestEventListener {
public:
    ReachedMutants(unsigned char* bytes, std::string name) : bytes_(bytes), lines_(name + ".tests") {}

    // Mistakes reached before a test belong to the whole suite, whose setup reached them.
    void OnTestStart(const ::testing::TestInfo& test) override
    {
        write(std::string(test.test_suite_name()) + ".*", true, 0);
    }

    void OnTestEnd(const ::testing::TestInfo& test) override
    {
        const ::testing::TestResult& result = *test.result();
        write(std::string(test.test_suite_name()) + "." + test.name(), result.Passed() || result.Skipped(),
              result.elapsed_time());
    }

private:
    void write(const std::string& name, bool passed, long long milliseconds)
    {
        lines_ << name << '\t' << passed << '\t' << milliseconds << '\t';
        for (int i = 0; i < kBytesOfReachedMutants; ++i) {
            if (bytes_[i]) {
                lines_ << i << ' ';
                bytes_[i] = 0;
            }
        }
        lines_ << std::endl;
    }

    unsigned char* bytes_;
    std::ofstream lines_;
};

const bool kListensForReachedMutants = [] {
    const char* name = std::getenv("COTAN_MUTANTS_REACHED");
    const int file = name ? open(name, O_RDWR) : -1;
    if (file < 0) {
        return false;
    }
    void* bytes = mmap(nullptr, kBytesOfReachedMutants, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    ::testing::UnitTest::GetInstance()->listeners().Append(
        new ReachedMutants(static_cast<unsigned char*>(bytes), name));
    return true;
}();

} // namespace
