"""The stages one by one."""

import numpy as np
import pytest
import remesh


def test_cleaning_tells_where_all_came_from(sphere):
    V, F = sphere
    soup = V[F].reshape(-1, 3)
    cleaned = remesh.clean(soup, np.arange(len(soup)).reshape(-1, 3))
    assert len(cleaned.V) == len(V) and cleaned.repairs["welded_vertices"] == len(soup) - len(V)
    assert np.array_equal(cleaned.V, soup[cleaned.source_vertex])
    assert np.array_equal(cleaned.source_face, np.arange(len(F)))
    same = remesh.clean(V, F)
    assert np.array_equal(same.V, V) and np.array_equal(same.F, F)
    assert same.F.dtype == F.dtype and not any(same.repairs.values())


def test_sampling_and_relaxing_by_hand(organic):
    V, F = organic
    first = remesh.sample_sites(V, F, 500, init="random", seed=3)
    assert first.face.shape == (500,) and first.barycentric.shape == (500, 3)
    relaxed = remesh.relax_sites(V, F, first)
    assert relaxed.energies[-1] < 0.8 * relaxed.energies[0]
    areas = [remesh.voronoi(V, F, sites).cell_area for sites in (first, relaxed.sites)]
    assert areas[1].std() < 0.5 * areas[0].std()


def test_relaxation_ends_by_the_callers_rule(organic):
    V, F = organic
    first = remesh.sample_sites(V, F, 500, init="random")
    told = []

    def stop(energies):
        told.append(list(energies))
        return len(energies) > 3

    relaxed = remesh.relax_sites(V, F, first, stop=stop)
    assert [len(energies) for energies in told] == [2, 3, 4]
    assert told[-1] == relaxed.energies.tolist()
    by_steps = remesh.relax_sites(V, F, first, steps=3)
    assert relaxed.sites.face.tobytes() == by_steps.sites.face.tobytes()
    assert relaxed.sites.barycentric.tobytes() == by_steps.sites.barycentric.tobytes()
    with pytest.raises(ZeroDivisionError):
        remesh.relax_sites(V, F, first, stop=lambda energies: 1 / 0)


def test_fixed_sites_stay(organic):
    V, F = organic
    first = remesh.sample_sites(V, F, 300)
    fixed = np.arange(300) < 20
    sites = remesh.relax_sites(V, F, first, fixed=fixed).sites
    stays = (sites.face == first.face) & (sites.barycentric == first.barycentric).all(axis=1)
    assert stays[:20].all() and stays[20:].mean() < 0.1
    with pytest.raises(remesh.InvalidOption, match="is_fixed has 2 entries, but there are 300"):
        remesh.relax_sites(V, F, first, fixed=[1, 0])


def test_own_sites_become_vertices(torus):
    V, F = torus
    sites = remesh.relax_sites(V, F, remesh.sample_sites(V, F, 400)).sites
    result = remesh.remesh(V, F, sites=sites, keep_sites=True)
    assert np.abs(result.V - sites.positions(V, F)).max() < 1e-12
    assert result.report["options"]["given_sites"] == 400


def test_wrong_options_are_refused(torus):
    with pytest.raises(remesh.InvalidOption, match="init is 'grid'; use blue-noise, farthest or"):
        remesh.sample_sites(*torus, 10, init="grid")
    with pytest.raises(remesh.InvalidOption, match="tolerance is -1"):
        remesh.relax_sites(*torus, [0, 1], tolerance=-1)
    with pytest.raises(remesh.InvalidOption, match="n is 0"):
        remesh.sample_sites(*torus, 0)


def test_evaluation_measures_both_meshes(torus):
    V, F = torus
    figures = remesh.evaluate(V, F, V, F, samples=1000)
    assert figures["topology_kept"] and figures["result"]["genus"] == 1
    assert figures["original"]["vertices"] == figures["result"]["vertices"] == len(V)
    if figures["distance"] is not None:
        assert figures["distance"]["two_sided"]["max_percent_of_diagonal"] < 1e-9
    with pytest.raises(remesh.InvalidInput, match="no face of the result mesh has an area"):
        remesh.evaluate(V, F, V, F[:0])
    with pytest.raises(remesh.InvalidInput, match=r"V2 has the shape"):
        remesh.evaluate(V, F, V[:, :2], F)
