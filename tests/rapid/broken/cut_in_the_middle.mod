! Field practice, Broken shapes: a file that was cut off.
MODULE cut_in_the_middle
  PROC main()
    TPWrite "one";
    FOR i FROM 1 TO 3 DO
      IF i=2 THEN
        TPWrite ValToStr(i    ! error: E102
