"""The module over a session of the program that LINKWORK names."""

import math
import signal
import sys
import time
from pathlib import Path

import pytest

import linkwork
from linkwork import LinkworkError, Session

FOUR_BAR = """
point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
crank: motor A B radius 1 speed 1rev
coupler: length B C = 3.5
length C D = 3
set dt 1/360
"""


@pytest.fixture
def session(tmp_path):
    with Session(out=tmp_path) as session:
        yield session


def test_statements_are_carried_out_and_answered(session):
    answer = session.run(FOUR_BAR + "step 90\nprint B, distance(A, B)\nlist points")
    assert answer.values[0] == pytest.approx([0, 1], abs=1e-12)
    assert answer.values[1] == pytest.approx(1, abs=1e-12)
    assert len(answer.lines) == 1
    assert answer.receipts[0]["frames"] == 90 and answer.receipts[0]["status"] == "converged"
    listing = answer.objects[-2]
    assert [point["name"] for point in listing["points"]] == ["A", "D", "B", "C"]
    assert answer.objects[-1]["type"] == "statement" and answer.objects[-1]["frame"] == 90


def test_values_keep_their_bits(session):
    assert session.evaluate("0.1 + 0.2") == 0.1 + 0.2
    assert session.evaluate("(1, 2)") == [1, 2]


def test_a_mistake_is_an_error_with_its_place(session):
    with pytest.raises(LinkworkError) as caught:
        session.run("let r = 2\nlenght A B\nlet r = 3")
    assert (caught.value.line, caught.value.column, caught.value.code) == (2, 1, "E0101")
    assert caught.value.helps == ["did you mean `length`?"]
    # What stands before it counts, what stands behind it does not.
    assert session.evaluate("r") == 2


def test_a_text_that_is_not_complete_is_a_mistake(session):
    with pytest.raises(LinkworkError, match="block|`}`"):
        session.run("for i in 1..3 {")
    assert session.evaluate("1") == 1


def test_questions_are_answered_by_dicts(session):
    session.run(FOUR_BAR)
    assert session.ask("check")["degrees_of_freedom"] == 0
    limits = session.ask("limits crank")
    assert limits["reach"] == "full" and limits["angle"]
    assert session.ask("show coupler")["constraints"][0]["points"] == ["B", "C"]


def test_what_answers_nothing_is_a_lookup_error(session):
    with pytest.raises(LookupError, match="`let r = 3` is none of list"):
        session.ask("let r = 3")
    with pytest.raises(LookupError, match="has no value"):
        session.evaluate('"a text"')
    with pytest.raises(LinkworkError, match="`get` knows"):
        session._get("nothing")


def test_the_answer_to_an_interrupted_question_is_skipped(session):
    session.run(FOUR_BAR)
    # Its asker hears nothing of it.
    session._send({"run": "print 1; list; nonsense"})
    session._send({"get": "svg"})
    assert session.evaluate("2") == 2
    assert session.ask("check")["degrees_of_freedom"] == 0


def test_a_question_that_takes_long_can_be_interrupted(session):
    session.run(FOUR_BAR)
    read, is_read = session._read, []

    def interrupted():
        # Ctrl-C in the middle of an answer.
        if len(is_read) == 3:
            raise KeyboardInterrupt
        is_read.append(read())
        return is_read[-1]

    session._read = interrupted
    with pytest.raises(KeyboardInterrupt):
        session.run("\n".join(f"print {k}" for k in range(100)))
    session._read = read
    assert session.evaluate("1 + 1") == 2


@pytest.mark.skipif(sys.platform == "win32", reason="it has no such signal")
def test_the_program_outlives_ctrl_c(session):
    # It goes to the whole group of processes: what waits for a question goes on waiting.
    for _ in range(3):
        _press_ctrl_c(session)
        assert session.evaluate("1 + 1") == 2
    # What runs is stopped: here it says that it runs.
    session.run(FOUR_BAR)
    number = session._send({"run": "for i in 1..1e6 { step 1000; i }"})
    assert session._read()["type"] == "print"
    _press_ctrl_c(session)
    while (it := session._read())["type"] != "done":
        pass
    assert it == {"type": "done", "id": number, "ok": False}
    assert session.evaluate("1 + 1") == 2


def _press_ctrl_c(session):
    """Ctrl-C that the program has taken in: on a busy machine it may come late, and stop what comes then."""
    process = session._process
    listener = _listener(process.pid)
    n_sleeps = listener and _n_sleeps(listener)
    process.send_signal(signal.SIGINT)
    if listener is None:
        time.sleep(1)
        return
    while _n_sleeps(listener) == n_sleeps:
        time.sleep(0.001)


def _listener(pid):
    """Where Linux tells of the thread that takes signals in."""
    for thread in Path(f"/proc/{pid}/task").glob("*"):
        if (thread / "comm").read_text(encoding="utf-8").strip() == "ctrl-c":
            return thread
    return None


def _n_sleeps(thread):
    lines = (thread / "status").read_text(encoding="utf-8").splitlines()
    return next(int(it.split()[1]) for it in lines if it.startswith("voluntary_ctxt_switches"))


@pytest.mark.skipif(sys.platform == "win32", reason="it has no such signals")
def test_what_is_interrupted_while_it_is_sent_is_left_out(session):
    def interrupt(*_):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, interrupt)
    # The program takes nothing: what is longer than a pipe is sent in part.
    session._process.send_signal(signal.SIGSTOP)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        with pytest.raises(KeyboardInterrupt):
            session.run("print 1\n" * 100_000)
    finally:
        session._process.send_signal(signal.SIGCONT)
        signal.signal(signal.SIGALRM, before)
    assert session.evaluate("1 + 1") == 2
    assert session.run("print 3").values == [3]


def test_traces_are_arrays(session):
    numpy = pytest.importorskip("numpy")
    session.run(FOUR_BAR + "trace B; step 360")
    x, y = session.traces()["B"]
    assert isinstance(x, numpy.ndarray) and x.shape == (360,)
    assert numpy.abs(numpy.hypot(x, y) - 1).max() < 1e-12


def test_named_paths_measures_and_fits_have_their_names(session):
    session.run(FOUR_BAR + 'trace B as "before"; measure d = distance(A, C); step 90')
    x, _ = session.traces()["before"]
    time, value = session.measures()["d"]
    assert len(x) == 90 and len(time) == len(value) == 90
    assert value[-1] == pytest.approx(session.evaluate("d.last"), abs=0)
    fit = session.run("let r = 1; fit r in 0..4 to minimise (r - 3)^2").fits[0]
    assert fit["parameters"]["r"] == pytest.approx(3, abs=1e-5) and fit["runs"] > 10


def test_traces_are_lists_without_numpy(session, monkeypatch):
    monkeypatch.setitem(sys.modules, "numpy", None)
    session.run(FOUR_BAR + "trace B; step 2")
    x, _ = session.traces()["B"]
    assert isinstance(x, list) and x[0] == pytest.approx(math.cos(math.tau / 360))


def test_files_lie_in_the_folder(session, tmp_path):
    answer = session.run(FOUR_BAR + 'svg "now.svg"')
    assert [tmp_path / "now.svg"] == [tmp_path / path.rsplit("/", 1)[-1] for path in answer.files]
    assert (tmp_path / "now.svg").read_text().startswith("<svg")


def test_a_notebook_shows_the_picture(session):
    session.run(FOUR_BAR)
    assert session._repr_svg_().startswith("<svg class=\"linkwork\"")


def test_a_script_brings_the_session_back(session):
    session.run(FOUR_BAR + "step 30")
    with Session() as other:
        other.run(session.script())
        assert other.evaluate("C") == session.evaluate("C")


def test_parameters_are_set_from_outside():
    with Session(set={"r": 2.5}) as session:
        assert session.run("let r = 1; print r").values == [2.5]


def test_a_program_that_is_gone_is_told(session):
    session._process.kill()
    with pytest.raises((EOFError, BrokenPipeError)):
        session.run("step")


def test_recordings_are_written_at_the_end(tmp_path):
    with Session(out=tmp_path) as session:
        session.run(FOUR_BAR + 'trace C; record "c.csv"; step 3')
    assert (tmp_path / "c.csv").read_text().count("\n") == 4


def test_the_version_is_that_of_the_schema():
    assert linkwork.VERSION == 1
