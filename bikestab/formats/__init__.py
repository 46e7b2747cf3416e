"""Readers for files of other programs, and writers: text → the parameters of one machine, and back.

They know parameters by their names and numbers, and no ``Bicycle``: that one checks what they give.
"""
