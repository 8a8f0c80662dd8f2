// The HTML pages that the program writes, in a real browser: they request nothing, have no errors, and their controls
// respond to pointer and keys.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "integration/report/browser.h"

namespace etendue::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kLeft = 37, kUp = 38, kRight = 39;

class Page : public testing::Test {
 protected:
  void SetUp() override {
    const auto program = Browser::program();
    if (!program) GTEST_SKIP() << "chromium is not installed";
    folder_ = fs::temp_directory_path() / ("etendue-pages-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    ::setenv("XDG_CACHE_HOME", folder_.c_str(), 1);
    browser_ = std::make_unique<Browser>(*program, folder_);
  }
  void TearDown() override {
    browser_.reset();
    std::error_code code;
    fs::remove_all(folder_, code);
  }

  // Runs the program in the folder.
  void etendue(const std::string& arguments) {
    const std::string command =
        "cd '" + folder_.string() + "' && '" ETENDUE_BINARY "' " + arguments + " >log 2>&1 </dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
  }
  void bench(const std::string& arguments) { etendue("bench cornell --size 32x32 --out b " + arguments); }
  void open_report(const std::string& fragment = "") { browser_->open(folder_ / "b" / "report.html", fragment); }

  json evaluate(const std::string& expression) { return browser_->evaluate(expression); }
  double number(const std::string& expression) { return evaluate(expression).get<double>(); }

  void expect_no_errors_or_requests() {
    EXPECT_TRUE(browser_->complaints().empty()) << browser_->complaints().front();
    for (const auto& address : browser_->requests())
      EXPECT_TRUE(address.starts_with("file://" + folder_.string()) || address.starts_with("data:")) << address;
  }

  // The page is no wider than the window.
  void expect_to_fit(int width) {
    browser_->resize(width, 800);
    EXPECT_LE(number("document.documentElement.scrollWidth"), width);
  }

  // The image of the comparison slider, without the dividing line and the border.
  std::string wipe_picture() {
    const json box =
        evaluate("(r => [r.x + scrollX, r.y + scrollY, r.width, r.height])($('wipe').getBoundingClientRect())");
    const double x = box[0], y = box[1], w = box[2], h = box[3];
    return browser_->screenshot(x + 0.1 * w, y + 0.1 * h, 0.8 * w, 0.8 * h);
  }

  fs::path folder_;
  std::unique_ptr<Browser> browser_;
};

TEST_F(Page, BenchmarkReportIsCompleteAndSelfContained) {
  bench("--methods path,path-pure:sampler=random --samples 16 --repeats 2");
  open_report();
  expect_no_errors_or_requests();
  EXPECT_EQ(number("document.querySelectorAll('.chart svg').length"), 2);
  EXPECT_EQ(number("document.querySelectorAll('.figures tbody tr').length"), 4);
  EXPECT_TRUE(
      evaluate("[...document.querySelectorAll('.figures td')].every(d => d.textContent.trim() && "
               "!/nan|inf/i.test(d.textContent))"));
  EXPECT_TRUE(evaluate("[...document.images].every(i => i.naturalWidth === 32 && i.naturalHeight === 32)"));
  // The reference, and an image, a difference and a FLIP map of each method.
  EXPECT_EQ(number("document.querySelectorAll('.gallery button').length"), 7);
  EXPECT_NE(evaluate("document.getElementById('command').textContent").get<std::string>().find("--samples 16"),
            std::string::npos);
  for (const int width : {1280, 600}) expect_to_fit(width);
  // The content security policy blocks requests of scripts.
  EXPECT_EQ(
      evaluate("new Promise(done => { addEventListener('securitypolicyviolation', e => done(e.effectiveDirective));"
               " fetch('http://127.0.0.1:9/').catch(() => {}); })"),
      "connect-src");
}

TEST_F(Page, BenchmarkSliderFollowsPointerKeysAndAddress) {
  bench("--methods path,path-pure:sampler=random --samples 4 --repeats 1");
  browser_->resize(900, 900);
  open_report("#left=0&right=2&wipe=0.3");
  EXPECT_EQ(evaluate("$('at').value"), "300");
  EXPECT_EQ(evaluate("$('edge').style.left"), "30%");

  evaluate("$('at').focus()");
  browser_->press("ArrowRight", kRight);
  EXPECT_EQ(evaluate("$('at').value"), "301");
  EXPECT_EQ(evaluate("$('over').style.clipPath"), "inset(0px 0px 0px 30.1%)");

  evaluate("$('wipe').scrollIntoView()");
  const json box = evaluate("(r => [r.x, r.y, r.width])($('wipe').getBoundingClientRect())");
  const double x = box[0], y = box[1], w = box[2];
  browser_->drag(x + 0.3 * w, y + 20, x + 0.75 * w, y + 20);
  EXPECT_NEAR(std::stod(evaluate("$('at').value").get<std::string>()), 750, 3);

  // Fully left shows the left image, fully right the right one.
  const auto shown = [&](int left, int right, const char* at) {
    open_report("#left=" + std::to_string(left) + "&right=" + std::to_string(right) + "&wipe=" + at);
    return wipe_picture();
  };
  const std::string reference = shown(0, 2, "1"), noisy = shown(0, 2, "0"), half = shown(0, 2, "0.5");
  EXPECT_TRUE(reference == shown(2, 0, "0"));
  EXPECT_TRUE(noisy == shown(2, 0, "1"));
  EXPECT_FALSE(reference == noisy);
  EXPECT_FALSE(half == reference || half == noisy);

  // A selected image is shown on the right.
  evaluate("document.querySelectorAll('.gallery button')[1].click()");
  EXPECT_EQ(evaluate("$('right').selectedIndex"), 1);
  EXPECT_EQ(evaluate("$('over').src === document.querySelectorAll('.gallery img')[1].src"), true);
  expect_no_errors_or_requests();
}

TEST_F(Page, BenchmarkChartIsReadWithPointerAndKeys) {
  bench("--methods path,path-pure --samples 16 --repeats 2");
  browser_->resize(1280, 800);
  open_report();
  const std::string tip = "document.querySelectorAll('.tip')[1]";
  EXPECT_EQ(evaluate(tip + ".hidden"), true);
  const json dot = evaluate(
      "(r => [r.x + r.width / 2, r.y + r.height / 2])"
      "(document.querySelectorAll('.chart')[1].querySelector('g circle').getBoundingClientRect())");
  browser_->move(dot[0], dot[1]);
  EXPECT_EQ(evaluate(tip + ".hidden"), false);
  EXPECT_TRUE(evaluate(tip + ".textContent").get<std::string>().starts_with("path\n1 spp\nRMSE "));

  evaluate("document.querySelectorAll('.chart')[1].focus()");
  browser_->press("ArrowRight", kRight);
  EXPECT_FALSE(evaluate(tip + ".textContent").get<std::string>().starts_with("path\n1 spp"));
  browser_->press("ArrowUp", kUp);
  EXPECT_TRUE(evaluate(tip + ".textContent").get<std::string>().starts_with("path-pure\n"));
  browser_->press("ArrowLeft", kLeft);
  EXPECT_TRUE(evaluate(tip + ".textContent").get<std::string>().starts_with("path-pure\n1 spp"));
  expect_no_errors_or_requests();
}

TEST_F(Page, BenchmarkReportIsValidForUnusualPlans) {
  etendue("render cornell --size 32x32 --spp 64 --seed 9 -o known.exr && '" ETENDUE_BINARY
          "' render cornell --size 32x32 --spp 64 --seed 9 -o unknown.hdr");
  for (const char* arguments :
       {"--methods path --samples 1 --repeats 1", "--methods path --samples 4 --reference known.exr",
        "--methods path --samples 4 --repeats 1 --reference unknown.hdr",
        "--methods path,path-pure,raycast,path:max-depth=2,path:sampler=halton,path:heuristic=balance:sampler=random "
        "--samples 8 --repeats 2"}) {
    SCOPED_TRACE(arguments);
    bench(arguments);
    open_report();
    expect_no_errors_or_requests();
    expect_to_fit(600);
    EXPECT_EQ(evaluate("/nan|inf\\b|undefined/i.test(document.body.innerText)"), false);
  }
}

TEST_F(Page, DarkModeFollowsThePreference) {
  bench("--methods path --samples 2 --repeats 1");
  open_report();
  const std::string ground = "getComputedStyle(document.body).backgroundColor";
  browser_->prefer("light");
  EXPECT_EQ(evaluate(ground), "rgb(255, 255, 255)");
  browser_->prefer("dark");
  EXPECT_EQ(evaluate(ground), "rgb(21, 24, 28)");
}

TEST_F(Page, StressMatrixLinksEachCaseToItsFindings) {
  etendue("stress --out b point-light-unseen index-of-one");
  browser_->open(folder_ / "b" / "matrix.html");
  expect_no_errors_or_requests();
  EXPECT_EQ(number("document.querySelectorAll('.overview a').length"), 2);
  EXPECT_EQ(evaluate("[...document.querySelectorAll('.overview a')].every(a => document.querySelector(a.hash))"), true);
  // An entry per result, which includes one of each unbiased integrator.
  const auto results = json::parse(std::ifstream(folder_ / "b" / "matrix.json")).size();
  EXPECT_GE(results, 6u);
  EXPECT_EQ(number("document.querySelectorAll('.results li').length"), static_cast<double>(results));
  EXPECT_EQ(evaluate("[...document.images].every(i => i.naturalWidth > 0)"), true);
  for (const int width : {1280, 600}) expect_to_fit(width);
}

}  // namespace
}  // namespace etendue::test
