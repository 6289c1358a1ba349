! Field practice, Broken shapes: ELSEIF without THEN.
MODULE elseif_without_then
  VAR num n;

  PROC main()
    IF n=1 THEN
      n:=2;
    ELSEIF n=2                            ! error: E142
      n:=3;
    ENDIF
  ENDPROC
ENDMODULE
