MODULE arrays
  CONST num rows:=2;
  VAR num cube{rows,3,2}:=[[[1,2],[3,4],[5,6]],[[7,8],[9,10],[11,12]]];
  PERS pos corners{3}:=[
    [0,0,0],      ! first
    [100,0,0],
    [100,100,0]
  ];
  VAR num total;
  PROC main()
    VAR num part{3};
    total:=Sum(cube);
    Fill part,+2;
    total:=total+part{Dim(part,1)}-corners{2}.x;
    TPWrite "Total "\Num:=total;
  ENDPROC
  FUNC num Sum(VAR num a{*,*,*})
    VAR num s;
    FOR i FROM 1 TO Dim(a,1) DO
      FOR j FROM 1 TO Dim(a,2) DO
        FOR k FROM 1 TO Dim(a,3) DO
          s:=s+a{i,j,k};
        ENDFOR
      ENDFOR
    ENDFOR
    RETURN s;
  ENDFUNC
  PROC Fill(INOUT num a{*},num value)
    FOR i FROM 1 TO Dim(a,1) DO
      a{i}:=value*i;
    ENDFOR
  ENDPROC
ENDMODULE
