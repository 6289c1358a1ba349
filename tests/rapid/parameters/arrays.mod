! RAPID Kernel, Parameters: {*} takes arrays of any size; Dim tells it.
MODULE array_parameters
  VAR num list{3}:=[1,2,3];
  VAR num table{2,2}:=[[1,2],[3,4]];
  VAR num cube{1,2,1}:=[[[5],[6]]];

  PROC main()
    TPWrite ValToStr(sum(list));          ! -> 6
    clear list;
    TPWrite ValToStr(list);               ! -> [0,0,0]
    TPWrite ValToStr(trace(table));       ! -> 5
    TPWrite ValToStr(depth(cube));        ! -> 1
  ENDPROC

  FUNC num sum(num values{*})
    VAR num total;
    FOR i FROM 1 TO Dim(values,1) DO
      total:=total+values{i};
    ENDFOR
    RETURN total;
  ENDFUNC

  PROC clear(INOUT num values{*})
    FOR i FROM 1 TO Dim(values,1) DO
      values{i}:=0;
    ENDFOR
  ENDPROC

  FUNC num trace(num m{*,*})
    RETURN m{1,1}+m{Dim(m,1),Dim(m,2)};
  ENDFUNC

  FUNC num depth(VAR num m{*,*,*})
    RETURN Dim(m,3);
  ENDFUNC
ENDMODULE
