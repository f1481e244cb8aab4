"""Tiles in one process, and by workers that may be lost."""

import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
import remesh
import remesh.distributed
import remesh.tiles


@pytest.fixture
def scan(tmp_path):
    V, F = remesh.examples.sphere(5)
    path = tmp_path / "scan.ply"
    remesh.write(path, V, F)
    return path


def test_what_tiles_give_is_a_mesh_with_so_many_vertices(scan, tmp_path):
    plan = remesh.tiles.split(scan, tmp_path / "a", 3000, tile=600)
    assert plan.num_faces == 8192 and plan.num_tiles == 5
    assert plan.area == pytest.approx(4 * np.pi, rel=2e-3)
    assert remesh.tiles.plan(tmp_path / "a") == plan
    assert sum(plan.vertices) > 3000 > plan.border_vertices > 0
    assert remesh.tiles.mesh(tmp_path / "a", [3, 1]) == (2, 0)
    calls = []
    assert remesh.tiles.mesh(tmp_path / "a", threads=2,
                             progress=lambda share, stage: calls.append((share, stage))) == (3, 2)
    assert calls[-1] == (1, "mesh")
    joined = remesh.tiles.join(tmp_path / "a")
    assert joined.V.shape == (3000, 3) and joined.F.shape == (5996, 3)
    assert np.abs(np.linalg.norm(joined.V, axis=1) - 1).max() < 3e-3


def test_what_is_wrong_is_said(scan, tmp_path):
    with pytest.raises(remesh.FileError, match="plan.json: is not there"):
        remesh.tiles.mesh(tmp_path)
    with pytest.raises(remesh.InvalidOption, match="499; use 500 or more"):
        remesh.tiles.split(scan, tmp_path / "a", 3000, tile=499)
    remesh.tiles.split(scan, tmp_path / "a", 500)
    with pytest.raises(remesh.InvalidOption, match="there is no tile 7"):
        remesh.tiles.mesh(tmp_path / "a", [7])
    with pytest.raises(remesh.InvalidOption, match="tiles"):
        remesh.tiles.mesh(tmp_path / "a", [-1])
    with pytest.raises(remesh.FileError, match="00000.mesh: is not there"):
        remesh.tiles.join(tmp_path / "a")


@pytest.fixture
def client():
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            yield client


def test_a_lost_worker_costs_its_tile_only(scan, tmp_path, client):
    remesh.tiles.split(scan, tmp_path / "one", 20000, tile=600)
    remesh.tiles.mesh(tmp_path / "one", threads=1)
    expected = remesh.tiles.join(tmp_path / "one")
    count = remesh.tiles.split(scan, tmp_path / "two", 20000, tile=600).num_tiles
    killed = []

    def kill_one():
        while len(list((tmp_path / "two").glob("*.mesh"))) < 3:
            time.sleep(0.01)
        workers = client.run(os.getpid)
        killed.append(min(workers.values()))
        os.kill(killed[0], signal.SIGKILL)

    killer = threading.Thread(target=kill_one)
    killer.start()
    shares = []
    made, there = remesh.distributed.mesh(tmp_path / "two", client,
                                          progress=lambda share, _: shares.append(share))
    killer.join()
    assert len(killed) == 1 and killed[0] not in client.run(os.getpid).values()
    # A tile whose mesh was written before its worker was lost counts as there.
    assert made + there == count and there <= 1
    assert shares == [i / count for i in range(1, count + 1)]
    found = remesh.tiles.join(tmp_path / "two")
    assert (found.V == expected.V).all() and (found.F == expected.F).all()


def test_a_failure_reaches_the_caller(scan, tmp_path, client):
    remesh.tiles.split(scan, tmp_path / "a", 3000, tile=600)
    (tmp_path / "a" / "00002.tile").write_bytes(b"no tile")
    with pytest.raises(remesh.FileError, match="00002.tile: is damaged"):
        remesh.distributed.mesh(tmp_path / "a", client, retries=1)


def test_one_command(scan, tmp_path):
    pytest.importorskip("distributed")
    out = tmp_path / "out.ply"
    done = subprocess.run([sys.executable, "-m", "remesh.distributed", scan, out, "-n", "3000",
                           "--tile", "600"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1] == "100 % of the tiles"
    assert remesh.read(out).V.shape == (3000, 3)


def test_creases_that_tiles_do_not_keep_are_a_warning(tmp_path):
    side, steps = np.arange(33) / 32, np.arange(32)
    V = np.array([[x, y, z] for z in (0, 1) for y in side for x in side])
    at = 33 * steps[:, None] + steps
    squares = np.stack([at, at + 1, at + 34, at + 33], axis=2).reshape(-1, 4)
    faces = np.vstack([squares[:, ::-1], squares + 33 * 33])
    rim = np.concatenate([steps, 33 * steps + 32, 33 * 32 + 32 - steps, 33 * (32 - steps)])
    walls = np.stack([rim, np.roll(rim, -1), np.roll(rim, -1) + 33 * 33, rim + 33 * 33], axis=1)
    quads = np.vstack([faces, walls])
    remesh.write(tmp_path / "box.ply", V, np.vstack([quads[:, :3], quads[:, [0, 2, 3]]]))
    with pytest.warns(UserWarning, match="creases of length .* tiles do not keep"):
        plan = remesh.tiles.split(tmp_path / "box.ply", tmp_path / "t", 2000)
    assert "creases" in plan.warning
    done = subprocess.run([sys.executable, "-m", "remesh.distributed", tmp_path / "none.ply", "out.ply"],
                          capture_output=True, text=True)
    assert done.returncode == 1 and "error:" in done.stderr and "Traceback" not in done.stderr
