//! The console blocks of the front page say what the program says.

#[test]
fn the_front_page_tells_the_truth() {
    trycmd::TestCases::new().case("README.md");
}
