import json

import pytest
import typer

from nao_sim.cli.export import export
from nao_sim.cli.gestures import gestures
from nao_sim.cli.play import play
from nao_sim.cli.stress import stress
from nao_sim.cli.validate import validate
from nao_sim.gestures import GestureError, UnknownGesture, library
from nao_sim.gestures.validation import validate_gesture

FAST = "time,HeadYaw,HeadPitch\n0.1,0,0\n0.2,100,0\n1.5,0,40\n"


def test_a_good_file_passes(write, good):
    found = validate_gesture(write(good))
    assert found.faults == []
    assert found.measures.fell_at is None
    assert 0 <= found.measures.range_use.min() <= found.measures.range_use.max() <= 1


def test_a_file_that_asks_for_too_much_is_refused_or_fitted(write):
    path = write(FAST, "fast.csv")
    refused = validate_gesture(path)
    assert "HeadPitch at 1.50 s is 40.00" in refused.faults[0]
    assert refused.measures is None
    fitted = validate_gesture(path, fitted=True)
    assert fitted.faults == []
    said = [str(change) for change in fitted.changes]
    assert any("HeadPitch at 1.50 s: angle 40.00 → 30.00" in line for line in said)
    assert any(line.startswith("HeadYaw") and "speed" in line for line in said)


def test_a_file_that_throws_the_robot_over_does_not_pass(write):
    text = "time,LAnklePitch,RAnklePitch\n0.4,-20,-20\n0.8,45,45\n2.5,45,45\n"
    found = validate_gesture(write(text, "over.csv"))
    assert any("fell at" in fault for fault in found.faults)


def test_validate_tells_and_draws(write, good, tmp_path, capsys):
    picture = tmp_path / "use.png"
    validate([str(write(good)), "yes"], figure=picture, as_json=True)
    rows = json.loads(capsys.readouterr().out)
    assert [row["faults"] for row in rows] == [[], []]
    assert rows[1]["tracking_deg"]["value"] < 2.0
    assert picture.read_bytes().startswith(b"\x89PNG")
    with pytest.raises(typer.Exit) as ended:
        validate(["yes", "nope"], as_json=False)
    assert ended.value.exit_code == 2
    assert "did you mean 'no'?" in " ".join(capsys.readouterr().out.split())


def test_validate_writes_the_fitted_motion(write, tmp_path, capsys):
    fitted = tmp_path / "fitted.csv"
    validate([str(write(FAST, "fast.csv"))], fit=True, out=fitted)
    assert validate_gesture(fitted).faults == []
    with pytest.raises(GestureError, match="--out needs --fit"):
        validate(["yes"], out=fitted)


def test_gestures_lists_the_library(capsys):
    gestures(as_json=True)
    rows = json.loads(capsys.readouterr().out)
    assert [row["name"] for row in rows] == list(library())
    assert rows[8] | {"number": 2, "name": "bye_right", "family": "small"} == rows[8]
    gestures(as_json=False)
    assert "bye_two_hands" in capsys.readouterr().out


def test_play_writes_a_complete_folder(tmp_path, capsys):
    play("yes", repetitions=1, mirror=True, out=tmp_path / "done", as_json=True)
    told = json.loads(capsys.readouterr().out)
    assert told["fell_at_s"] is None
    assert sorted(path.name for path in (tmp_path / "done").iterdir()) == ["asked.csv", "motion.csv", "motion.json"]
    assert json.loads((tmp_path / "done" / "motion.json").read_text()) == told
    with pytest.raises(UnknownGesture):
        play("yess", out=tmp_path / "not")
    assert not (tmp_path / "not").exists()


def test_export_says_what_it_wrote(tmp_path, capsys):
    export("no", tmp_path / "no.motion", speed=3.0)
    said = capsys.readouterr()
    assert "no.motion: no," in said.out
    assert "changed: HeadYaw" in said.err
    assert validate_gesture(tmp_path / "no.motion").faults == []


def test_stress_and_replay_on_the_command_line(capsys):
    stress("yes", trials=4, seed=3, sweep=False, as_json=True)
    told = json.loads(capsys.readouterr().out)
    assert (told["trials"], told["upright_share"]) == (4, 1.0)
    stress("yes", seed=3, replay=2, as_json=True)
    told = json.loads(capsys.readouterr().out)
    assert told["fell_at_s"] is None
    assert told["trial"] == 2
