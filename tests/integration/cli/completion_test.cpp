// Completion scripts, as a shell uses them.
#include "integration/cli/cli.h"

namespace etendue::test::completion_test {
namespace {

class Completion : public Cli {
 protected:
  // What bash offers for the last of these words.
  std::string offered(const std::string& words) {
    EXPECT_EQ(run("completion bash").code, 0);
    const std::string script = (folder_ / "complete.sh").string(), answer = (folder_ / "answer.txt").string();
    fs::copy_file(folder_ / "out.txt", script, fs::copy_options::overwrite_existing);
    const std::string command = "cd " + folder_.string() + " && bash -c '. " + script + "; COMP_WORDS=(" + words +
                                "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _etendue; echo \"${COMPREPLY[@]}\"' >" +
                                answer + " 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return slurp(answer);
  }
};

TEST_F(Completion, OffersCommandsOptionsAndNames) {
  EXPECT_EQ(offered("etendue ren"), "render\n");
  EXPECT_EQ(offered("etendue render --integ"), "--integrator\n");
  EXPECT_EQ(offered("etendue render --integrator path"), "path-pure path path-guided path-control path-manifold\n");
  EXPECT_EQ(offered("etendue render glass-c"), "glass-caustic\n");
  EXPECT_EQ(offered("etendue compare --heatmap-of fl"), "flip\n");
}

TEST_F(Completion, EachShellHasAScript) {
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const Outcome r = run(std::string("completion ") + shell);
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_NE(r.out.find("integrator"), std::string::npos) << shell;
  }
  expect_error("completion tcsh", 2, "tcsh");
}

}  // namespace
}  // namespace etendue::test::completion_test
