"""The ``nao-sim`` command: one module a command, imported only when it is called."""

EXIT_STOPPED = 130


def main() -> None:
    """Run the command line; to be stopped by Ctrl-C, even this early, is one line."""
    try:
        from nao_sim.cli.app import main as run

        run()
    except KeyboardInterrupt:
        import sys

        sys.stderr.write("nao-sim: stopped\n")
        raise SystemExit(EXIT_STOPPED) from None


__all__ = ["main"]
