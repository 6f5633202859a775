// The scripts' promises about packages and processors, with a make-believe apt, dpkg and sudo in front of the
// real ones.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

namespace {

namespace fs = std::filesystem;

struct Outcome {
    int status = -1;
    std::string output;  // stdout and stderr
};

Outcome shell(const std::string& command) {
    Outcome outcome;
    FILE* pipe = popen(("exec 2>&1 </dev/null; " + command).c_str(), "r");
    if (pipe == nullptr) return outcome;
    char buffer[4096];
    while (const std::size_t count = fread(buffer, 1, sizeof buffer, pipe))
        outcome.output.append(buffer, count);
    const int status = pclose(pipe);
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
}

std::string read(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

/// A folder with a package list and the few programs that scripts/lib.sh may call, nothing else on the PATH.
/// The file `installed` is what dpkg knows, `calls` what apt-get and sudo were asked.
class Scripts : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "seaglare_scripts_XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        folder = name;
        fs::create_directories(folder / "bin");
        fs::create_directories(folder / "scripts");
        write("scripts/packages.txt", "# the list\nalpha build # first\nbeta  build\n\ngamma test\n");
        write("installed", "");
        write("calls", "");
        for (const char* tool : {"bash", "dirname", "env", "cat", "grep"}) {
            fs::create_symlink(shell(std::string("printf %s \"$(command -v ") + tool + ")\"").output,
                               folder / "bin" / tool);
        }
        program("dpkg-query", R"(for name; do
            [[ $name == --* ]] || ! grep -qxF "$name" "$folder/installed" || echo "installed $name"
        done)");
        program("apt-get", R"(echo "apt-get ${DEBIAN_FRONTEND:-} $*" >>"$folder/calls"
        [[ " $* " != *" install "* ]] || for name; do echo "$name" >>"$folder/installed"; done)");
    }
    void TearDown() override { fs::remove_all(folder); }

    void write(const char* name, const std::string& text) const { std::ofstream(folder / name) << text; }

    void program(const std::string& name, const std::string& body) const {
        const fs::path path = folder / "bin" / name;
        std::ofstream(path) << "#!" << (folder / "bin/bash").string() << "\nfolder=" << folder << "\n"
                            << body << "\n";
        fs::permissions(path, fs::perms::owner_all);
    }

    /// Runs `commands` with scripts/lib.sh sourced, for a user who is root or is not.
    [[nodiscard]] Outcome run(const std::string& commands, bool as_root) const {
        return shell("PATH=" + (folder / "bin").string() +
                     " bash -c 'source " SEAGLARE_SOURCE_DIR "/scripts/lib.sh; root=" + folder.string() +
                     "; is_root() { " + (as_root ? "true" : "false") + "; }; " + commands + "'");
    }

    [[nodiscard]] std::string calls() const { return read(folder / "calls"); }

    fs::path folder;
};

TEST_F(Scripts, AskAptForNothingWhenEverythingIsInstalled) {
    write("installed", "alpha\nbeta\n");
    const Outcome outcome = run("ensure_packages build", false);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_EQ(calls(), "");
}

TEST_F(Scripts, InstallOnlyWhatIsMissingAndNothingThatIsMerelyRecommended) {
    write("installed", "alpha\n");
    const Outcome outcome = run("ensure_packages build test", true);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_NE(calls().find("install --no-install-recommends beta gamma\n"), std::string::npos) << calls();
    EXPECT_NE(calls().find("apt-get noninteractive "), std::string::npos) << calls();
}

TEST_F(Scripts, LeaveOutGroupsThatWereNotAskedFor) {
    EXPECT_EQ(run("list_packages build", true).output, "alpha\nbeta\n");
    EXPECT_EQ(run("list_packages test", true).output, "gamma\n");
}

TEST_F(Scripts, RefuseAGroupThatDoesNotExist) {
    const Outcome outcome = run("ensure_packages biuld", true);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.output.find("no package in the group"), std::string::npos) << outcome.output;
    EXPECT_EQ(calls(), "");
}

TEST_F(Scripts, GoThroughSudoWhenTheUserIsNotRoot) {
    program("sudo", R"(echo "sudo $*" >>"$folder/calls"
        while [[ $1 == -* ]]; do shift; done
        "$@")");
    program("true", "exit 0");
    const Outcome outcome = run("ensure_packages build", false);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_NE(calls().find("sudo -n -- env DEBIAN_FRONTEND=noninteractive apt-get"), std::string::npos)
        << calls();
    EXPECT_EQ(read(folder / "installed").find("gamma"), std::string::npos);
}

TEST_F(Scripts, SayWhatToRunWhereThereIsNeitherRootNorSudo) {
    const Outcome outcome = run("ensure_packages build", false);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.output.find("there is no sudo"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("apt-get install --no-install-recommends alpha beta"), std::string::npos);
    EXPECT_EQ(calls(), "");
}

TEST_F(Scripts, DoNotWaitForAPasswordThatNobodyCanType) {
    program("sudo", "exit 1");
    const Outcome outcome = run("ensure_packages build", false);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.output.find("sudo wants a password"), std::string::npos) << outcome.output;
    EXPECT_EQ(calls(), "");
}

TEST_F(Scripts, NameThePackagesThatAptCouldNotInstall) {
    program("apt-get",
            "[[ \" $* \" == *\" update \"* ]] || { echo 'E: Unable to locate package beta'; exit 100; }");
    write("installed", "alpha\n");
    const Outcome outcome = run("ensure_packages build", true);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.output.find("apt-get could not install: beta\n"), std::string::npos) << outcome.output;
}

TEST_F(Scripts, TryTheOldPackageListsWhenNewOnesCannotBeHad) {
    program("apt-get", R"([[ " $* " != *" update "* ]] || exit 100
        for name; do echo "$name" >>"$folder/installed"; done)");
    const Outcome outcome = run("ensure_packages build", true);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("apt-get update failed"), std::string::npos) << outcome.output;
}

TEST_F(Scripts, NoticeThatAptClaimedASuccessItDidNotHave) {
    program("apt-get", "exit 0");
    const Outcome outcome = run("ensure_packages build", true);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.output.find("still missing: alpha beta"), std::string::npos) << outcome.output;
}

TEST_F(Scripts, NameThePackagesWhereThereIsNoApt) {
    fs::remove(folder / "bin/apt-get");
    Outcome outcome = run("ensure_packages build", true);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.output.find("not a Debian system"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("alpha beta"), std::string::npos) << outcome.output;
    outcome = run("SEAGLARE_SKIP_PACKAGES=1; ensure_packages build", true);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
}

TEST_F(Scripts, StartAsManyCompilersAsProcessorsAndMemoryAllow) {
    EXPECT_EQ(run("job_count 2 100000", true).output, "2\n");
    EXPECT_EQ(run("job_count 64 8192", true).output, "8\n");
    EXPECT_EQ(run("job_count 4 300", true).output, "1\n");
}

TEST(Packages, EachIsListedOnceInAKnownGroup) {
    // `bench` and `s57` are for what no script builds.
    const std::set<std::string> groups = {"build", "test", "ci", "bench", "s57"};
    std::ifstream list(SEAGLARE_SOURCE_DIR "/scripts/packages.txt");
    std::map<std::string, std::string> group_of;
    std::string line;
    while (std::getline(list, line)) {
        std::istringstream words(line.substr(0, line.find('#')));
        std::string package, group, more;
        if (!(words >> package)) continue;
        EXPECT_TRUE(words >> group) << line;
        EXPECT_FALSE(words >> more) << line;
        EXPECT_TRUE(groups.contains(group)) << line;
        EXPECT_TRUE(group_of.emplace(package, group).second) << package << " is listed twice";
    }
    EXPECT_EQ(group_of["g++"], "build");
    EXPECT_EQ(group_of["libgtest-dev"], "test");
    EXPECT_EQ(group_of["libfftw3-dev"], "test")
        << "FFTW is GPL: what is built without tests must not need it";
}

}  // namespace
