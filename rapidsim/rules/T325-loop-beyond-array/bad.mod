MODULE example
  VAR num heights{10};
  PROC main()
    FOR i FROM 1 TO 11 DO
      heights{i}:=5*i; ! found
    ENDFOR
  ENDPROC
ENDMODULE
! ---
MODULE bad
  CONST num rows:=4;
  VAR num heights{10};
  VAR pos grid{3,4};
  VAR num i;
  PROC main()
    FOR i FROM 0 TO 9 DO
      heights{i}:=1;                  ! found
    ENDFOR
    FOR i FROM 1 TO Dim(heights,1) DO
      IF reg1>3 heights{i}:=heights{i+1};  ! found
    ENDFOR
    FOR row FROM 1 TO rows DO
      FOR column FROM 1 TO 4 DO
        grid{row,column}.x:=100*row;  ! found
      ENDFOR
    ENDFOR
    FOR i FROM 10 TO 1 STEP -3 DO
      heights{i-1}:=2;                ! found
    ENDFOR
    i:=1;
    WHILE i<=11 DO
      heights{i}:=3;                  ! found
      i:=i+1;
    ENDWHILE
    sum heights;
  ENDPROC
  PROC sum(num values{*})
    FOR i FROM 0 TO Dim(values,1)-1 DO
      reg1:=reg1+values{i};           ! found
    ENDFOR
  ENDPROC
ENDMODULE
