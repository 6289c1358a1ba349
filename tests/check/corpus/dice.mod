MODULE dice
  VAR num seed:=17;
  FUNC num roll(num faces)
    seed:=(seed*75+74) MOD 65537;
    RETURN 1+seed MOD faces;
  ENDFUNC
  PROC main()
    VAR num count{6};
    VAR num face;
    FOR throw FROM 1 TO 60 DO
      face:=roll(6);
      Incr count{face};
      Add count{face},0;
    ENDFOR
    FOR i FROM 1 TO 6 DO
      TPWrite ValToStr(i)+": "+ValToStr(count{i});
    ENDFOR
  ENDPROC
ENDMODULE
