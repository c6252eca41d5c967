"""Made-up sessions for tests."""

from dataclasses import replace

from nao_sim.game.made_up import Recipe, make_up
from nao_sim.game.tables import Tables, write_tables


def made(seed=1, **recipe):
    return make_up(Recipe(**({"sessions": 1, "turns": 5} | recipe)), seed)


def session_of(tables: Tables, name: str) -> Tables:
    ids = {t.turn_id for t in tables.turns if t.session == name}
    return Tables(
        tuple(s for s in tables.sessions if s.session == name),
        tuple(t for t in tables.turns if t.session == name),
        tuple(r for r in tables.ratings if r.turn_id in ids),
        tuple(e for e in tables.events if e.session == name),
    )


def store(tables: Tables, folder):
    for s in tables.sessions:
        write_tables(folder / s.session, session_of(tables, s.session))
    return folder


def with_settings(tables: Tables, **settings) -> Tables:
    return replace(tables, sessions=tuple(replace(s, **settings) for s in tables.sessions))
