"""``python -m nao_sim`` is ``nao-sim``."""

from nao_sim.cli import main

if __name__ == "__main__":
    main()
